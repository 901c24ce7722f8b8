#include "lift_slam/image/self_similarity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using Gray = std::function<double(int x, int y)>;

ImagePyramid MakePyramid(int width, int height, const Gray& gray) {
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at<uchar>(y, x) = cv::saturate_cast<uchar>(gray(x, y));
  }
  return BuildPyramid(GrayImage(image), {});
}

const Eigen::Vector2d kAlongRows(1.0, 0.0), kAlongColumns(0.0, -2.0);

// Posts every 20 pixels of different brightness, on ground that is noise.
ImagePyramid Fence() {
  Random random(3);
  return MakePyramid(320, 120, [&](int x, int y) {
    const bool is_post = x % 20 < 6 && y > 40 && y < 80;
    return is_post ? 150.0 + x / 8.0 - y / 4.0 : random.Uniform(80.0, 84.0);
  });
}

TEST(SelfSimilarity, PostOfAFenceIsLikeTheNextOne) {
  EXPECT_GT(SelfSimilarityAlong(Fence(), {163.0, 42.0}, kAlongRows, 1.0), 0.95);
}

TEST(SelfSimilarity, PostIsNotRepeatedAcrossTheFence) {
  EXPECT_LT(SelfSimilarityAlong(Fence(), {163.0, 42.0}, kAlongColumns, 1.0), 0.7);
}

TEST(SelfSimilarity, NextPostOutOfReachDoesNotCount) {
  const SelfSimilarityOptions options{.min_offset_px = 4.0, .reach_px = 9.0};
  EXPECT_LT(SelfSimilarityAlong(Fence(), {163.0, 42.0}, kAlongRows, 1.0, options), 0.8);
}

TEST(SelfSimilarity, CoarserLevelSeesTheSame) {
  EXPECT_GT(SelfSimilarityAlong(Fence(), {163.0, 42.0}, kAlongRows, 1.44), 0.9);
}

TEST(SelfSimilarity, EdgeIsLikeItselfAlongIt) {
  const ImagePyramid edge =
      MakePyramid(300, 300, [](int x, int y) { return x + 2 * y > 450 ? 180.0 : 60.0; });
  EXPECT_GT(SelfSimilarityAlong(edge, {150.0, 150.0}, {2.0, -1.0}, 1.0), 0.95);
}

TEST(SelfSimilarity, RandomTextureIsUnique) {
  Random random(5);
  Eigen::MatrixXd coarse(60, 60);
  for (double& value : coarse.reshaped()) value = random.Uniform(0.0, 255.0);
  const ImagePyramid texture =
      MakePyramid(240, 240, [&](int x, int y) { return coarse(x / 4, y / 4); });
  for (int k = 0; k < 50; ++k) {
    const Eigen::Vector2d center(random.Uniform(30.0, 210.0), random.Uniform(30.0, 210.0));
    const double angle = random.Uniform(0.0, 2.0 * std::numbers::pi);
    EXPECT_LT(SelfSimilarityAlong(texture, center, {std::cos(angle), std::sin(angle)}, 1.0), 0.85);
  }
}

TEST(SelfSimilarity, NothingToSeeOrToCompare) {
  const ImagePyramid flat = MakePyramid(100, 100, [](int, int) { return 90.0; });
  EXPECT_EQ(SelfSimilarityAlong(flat, {50.0, 50.0}, kAlongRows, 1.0), 1.0);
  EXPECT_EQ(SelfSimilarityAlong(flat, {2.0, 50.0}, kAlongRows, 1.0), -1.0);
  EXPECT_EQ(SelfSimilarityAlong(flat, {50.0, 50.0}, {0.0, 0.0}, 1.0), -1.0);
  EXPECT_EQ(SelfSimilarityAlong({}, {50.0, 50.0}, kAlongRows, 1.0), -1.0);
}

}  // namespace
}  // namespace lift_slam
