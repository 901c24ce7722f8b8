#include "lift_slam/image/patch_alignment.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <opencv2/core.hpp>

namespace lift_slam {
namespace {

constexpr int kWidth = 160, kHeight = 120;
const Eigen::Vector2d kPlace(70.0, 60.0);  // of the patch in the reference

// A smooth texture on the plane, of any resolution.
double Texture(const Eigen::Vector2d& p, double phase) {
  return 40.0 * std::sin(0.55 * p.x() + 0.21 * p.y() + phase) +
         35.0 * std::sin(-0.17 * p.x() + 0.62 * p.y() + 2.0 * phase) +
         20.0 * std::sin(0.35 * p.x() + 0.4 * p.y() + 3.0 * phase);
}

// The image whose pixel p shows the texture at kPlace + inverse(a) (p - center).
struct Rendering {
  Eigen::Matrix2d a = Eigen::Matrix2d::Identity();
  Eigen::Vector2d center = kPlace;
  double gain = 1.0, offset = 0.0, phase = 0.3;
};

ImagePyramid Render(const Rendering& rendering) {
  cv::Mat image(kHeight, kWidth, CV_8UC1);
  const Eigen::Matrix2d inverse = rendering.a.inverse();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector2d p = kPlace + inverse * (Eigen::Vector2d(x, y) - rendering.center);
      const double value = 120.0 + rendering.offset + rendering.gain * Texture(p, rendering.phase);
      image.at<uchar>(y, x) = cv::saturate_cast<uchar>(value);
    }
  }
  return BuildPyramid(GrayImage(image), {});
}

ReferencePatch Reference(double scale = 1.0) {
  const auto patch = CutReferencePatch(Render({}), kPlace, scale);
  EXPECT_TRUE(patch.has_value());
  return patch.value_or(ReferencePatch{});
}

// Looks for the patch from `error` beside its true centre.
std::optional<PatchAlignment> Find(const Rendering& rendering, const Eigen::Vector2d& error,
                                   const PatchAlignmentOptions& options = {}) {
  PatchView expected;
  expected.center = rendering.center + error;
  expected.image_from_patch = rendering.a;
  return AlignPatch(Reference(), Render(rendering), expected, options);
}

TEST(PatchAlignment, FindsAShiftOfAFractionOfAPixel) {
  const Rendering rendering{.center = {81.37, 48.81}};
  const auto found = Find(rendering, {-0.6, 0.7});
  ASSERT_TRUE(found);
  EXPECT_LT((found->center - rendering.center).norm(), 0.02);
  EXPECT_NEAR(found->shift_px, std::hypot(0.6, 0.7), 0.03);
  EXPECT_LT(found->residual, 0.05);
}

TEST(PatchAlignment, ScaleAndRotationOfThePredictionAreFollowed) {
  Rendering rendering{.center = {80.2, 62.6}};
  rendering.a << 1.4, -0.3, 0.3, 1.4;
  const auto found = Find(rendering, {0.8, 0.5});
  ASSERT_TRUE(found);
  EXPECT_LT((found->center - rendering.center).norm(), 0.03);
}

TEST(PatchAlignment, GainAndOffsetDoNotMatter) {
  const Rendering rendering{.center = {75.7, 55.2}, .gain = 0.6, .offset = 40.0};
  const auto found = Find(rendering, {0.5, -0.5});
  ASSERT_TRUE(found);
  EXPECT_LT((found->center - rendering.center).norm(), 0.03);
}

TEST(PatchAlignment, AShearAlongTheParallaxIsFound) {
  Rendering rendering{.center = {80.4, 60.3}};
  rendering.a << 1.0, 0.15, 0.0, 1.0;
  PatchView expected;
  expected.center = rendering.center + Eigen::Vector2d(0.4, 0.4);
  expected.parallax = {10.0, 0.0};
  const auto found = AlignPatch(Reference(), Render(rendering), expected, {});
  ASSERT_TRUE(found);
  EXPECT_LT((found->center - rendering.center).norm(), 0.03);
  expected.parallax.setZero();  // the shear is no unknown then
  const auto without = AlignPatch(Reference(), Render(rendering), expected, {});
  EXPECT_TRUE(!without || without->residual > 2.0 * found->residual);
}

TEST(PatchAlignment, ACoarsePatchIsFoundOnACoarseLevel) {
  const double scale = std::pow(1.2, 3);
  const ReferencePatch patch = Reference(scale);
  const Rendering rendering{.center = {72.3, 58.9}};
  PatchView expected;
  expected.center = rendering.center + Eigen::Vector2d(1.2, -0.8);
  expected.image_from_patch = scale * Eigen::Matrix2d::Identity();
  const auto found = AlignPatch(patch, Render(rendering), expected, {});
  ASSERT_TRUE(found);
  EXPECT_LT((found->center - rendering.center).norm(), 0.05 * scale);
}

TEST(PatchAlignment, AnotherTextureIsRefused) {
  EXPECT_FALSE(Find({.phase = 1.9}, {0.0, 0.0}));
  EXPECT_FALSE(Find({.phase = 3.1}, {0.0, 0.0}));
}

TEST(PatchAlignment, InvertedContrastIsRefused) { EXPECT_FALSE(Find({.gain = -1.0}, {0.0, 0.0})); }

TEST(PatchAlignment, AShiftBeyondTheLimitIsRefused) {
  const Rendering rendering{.center = {80.0, 60.0}};
  EXPECT_TRUE(Find(rendering, {1.0, 0.0}));
  EXPECT_FALSE(Find(rendering, {1.0, 0.0}, {.max_shift_px = 0.5}));
}

TEST(PatchAlignment, APatchWithoutTextureIsRefused) {
  cv::Mat plain(kHeight, kWidth, CV_8UC1, cv::Scalar(90));
  const ImagePyramid image = BuildPyramid(GrayImage(plain), {});
  const auto patch = CutReferencePatch(image, kPlace, 1.0);
  ASSERT_TRUE(patch);
  PatchView expected;
  expected.center = kPlace;
  EXPECT_FALSE(AlignPatch(*patch, image, expected, {}));
}

TEST(PatchAlignment, AnEdgeThatLeavesThePositionOpenIsRefused) {
  cv::Mat edge(kHeight, kWidth, CV_8UC1);
  cv::Mat noise(kHeight, kWidth, CV_8UC1);
  cv::RNG random(3);
  random.fill(noise, cv::RNG::UNIFORM, 0, 12);
  for (int x = 0; x < kWidth; ++x) edge.col(x).setTo(x < kPlace.x() ? 60 : 140);
  cv::Mat with_noise = edge + noise;
  const auto patch = CutReferencePatch(BuildPyramid(GrayImage(edge), {}), kPlace, 1.0);
  ASSERT_TRUE(patch);
  PatchView expected;
  expected.center = kPlace;
  EXPECT_FALSE(AlignPatch(*patch, BuildPyramid(GrayImage(with_noise), {}), expected, {}));
}

TEST(PatchAlignment, TheImageBorderIsRespected) {
  const ImagePyramid image = Render({});
  EXPECT_FALSE(CutReferencePatch(image, {3.0, 60.0}, 1.0));
  EXPECT_FALSE(CutReferencePatch(image, {60.0, kHeight - 2.0}, 1.0));
  EXPECT_FALSE(CutReferencePatch(ImagePyramid{}, kPlace, 1.0));
  PatchView expected;
  expected.center = {kWidth - 4.0, 60.0};
  EXPECT_FALSE(AlignPatch(Reference(), image, expected, {}));
  expected.center = {std::nan(""), 60.0};
  EXPECT_FALSE(AlignPatch(Reference(), image, expected, {}));
  expected.center = kPlace;
  expected.image_from_patch.setZero();
  EXPECT_FALSE(AlignPatch(Reference(), image, expected, {}));
}

}  // namespace
}  // namespace lift_slam
