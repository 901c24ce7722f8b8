#include "lift_slam/features/image_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

// Two views of points in a box; the first `num_wrong` of the second view are somewhere else.
// Feature i of the one is feature (size - 1 - i) of the other.
struct TwoViews {
  Camera camera{{.fx = 500, .fy = 520, .cx = 320, .cy = 240, .width = 640, .height = 480},
                RadialTangential{.k1 = -0.2, .k2 = 0.05}};
  FeatureSet a, b;

  TwoViews(int size, int num_wrong) {
    const DescriptorKind kind{"test", DescriptorMetric::kL2, 16};
    Random random(4);
    a = {std::vector<Keypoint>(static_cast<std::size_t>(size)),
         Descriptors(kind, static_cast<std::size_t>(size))};
    b = a;
    for (int i = 0; i < size; ++i) {
      const auto in_a = static_cast<std::size_t>(i);
      const auto in_b = static_cast<std::size_t>(size - 1 - i);
      const Eigen::Vector3d point(random.Uniform(-2, 2), random.Uniform(-1.5, 1.5),
                                  random.Uniform(5, 12));
      const double turn = 0.05;
      const Eigen::Vector3d seen(std::cos(turn) * point.x() - std::sin(turn) * point.z() + 0.8,
                                 point.y() - 0.1,
                                 std::sin(turn) * point.x() + std::cos(turn) * point.z() - 0.3);
      Place(point, random, a.keypoints[in_a]);
      Place(seen, random, b.keypoints[in_b]);
      if (i < num_wrong) {
        b.keypoints[in_b].x = static_cast<float>(random.Uniform(0, 639));
        b.keypoints[in_b].y = static_cast<float>(random.Uniform(0, 479));
      }
      float values[16];
      for (float& v : values) v = static_cast<float>(random.Normal());
      std::memcpy(a.descriptors.mutable_row(in_a).data(), values, sizeof values);
      for (float& v : values) v += static_cast<float>(0.01 * random.Normal());
      std::memcpy(b.descriptors.mutable_row(in_b).data(), values, sizeof values);
    }
  }

  void Place(const Eigen::Vector3d& point, Random& random, Keypoint& keypoint) const {
    const auto pixel = camera.Project(point);
    keypoint.x = static_cast<float>(pixel.value().x() + 0.3 * random.Normal());
    keypoint.y = static_cast<float>(pixel.value().y() + 0.3 * random.Normal());
  }
};

TEST(MatchImagePair, EssentialMatrixTellsInliersFromOutliers) {
  const TwoViews views(200, 80);
  const ImagePairResult result = MatchImagePair(views.a, views.b, &views.camera, {});
  EXPECT_EQ(result.model, EpipolarModel::kEssential);
  ASSERT_EQ(result.matches.size(), 200U);
  int num_right = 0, num_wrong = 0;
  for (const ImagePairMatch& match : result.matches) {
    EXPECT_EQ(match.b, 199 - match.a);
    (match.a < 80 ? num_wrong : num_right) += match.is_inlier ? 1 : 0;
  }
  EXPECT_GE(num_right, 118);
  EXPECT_LE(num_wrong, 12);  // by chance within 2 pixels of their epipolar line
  EXPECT_EQ(result.num_inliers, num_right + num_wrong);
  EXPECT_TRUE(std::ranges::is_sorted(result.matches, {}, &ImagePairMatch::distance));
}

TEST(MatchImagePair, WithoutACameraTheFundamentalMatrixDoesNearlyAsWell) {
  const TwoViews views(200, 80);
  const ImagePairResult result = MatchImagePair(views.a, views.b, nullptr, {.max_error_px = 3.0});
  EXPECT_EQ(result.model, EpipolarModel::kFundamental);
  EXPECT_GE(result.num_inliers, 100);  // the distortion is not modelled
  EXPECT_LE(result.num_inliers, 150);
  const ImagePairResult again = MatchImagePair(views.a, views.b, nullptr, {.max_error_px = 3.0});
  EXPECT_EQ(result.num_inliers, again.num_inliers);
}

TEST(MatchImagePair, TooFewMatchesHaveNoModel) {
  for (const int size : {0, 1, 6}) {
    const TwoViews views(size, 0);
    for (const Camera* camera : {&views.camera, static_cast<const Camera*>(nullptr)}) {
      const ImagePairResult result = MatchImagePair(views.a, views.b, camera, {});
      EXPECT_EQ(result.model, EpipolarModel::kNone);
      EXPECT_EQ(result.num_inliers, 0);
      EXPECT_EQ(result.matches.size(), static_cast<std::size_t>(size));
    }
  }
}

}  // namespace
}  // namespace lift_slam
