#include "lift_slam/geometry/absolute_pose.h"

#include <gtest/gtest.h>

#include "lift_slam/geometry/p3p.h"
#include "lift_slam/testing/rigid3_matchers.h"
#include "lift_slam/testing/synthetic_scene.h"

namespace lift_slam {
namespace {

const Rigid3d kCamFromWorld(
    Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Eigen::Vector3d(0.3, 1.0, -0.2).normalized())),
    {-0.8, 0.1, 0.6});

std::vector<PointMatch> Matches(const SyntheticSceneOptions& options) {
  const SyntheticScene scene = MakeSyntheticScene({kCamFromWorld}, options);
  std::vector<PointMatch> matches;
  for (const SyntheticObservation& observation : scene.observations[0]) {
    matches.push_back({scene.points[static_cast<std::size_t>(observation.point)],
                       scene.pinhole.Unproject(observation.pixel).head<2>(), 0.5});
  }
  return matches;
}

TEST(P3p, OneSolutionIsThePoseForEveryTriple) {
  SyntheticSceneOptions options;
  options.noise_px = 0.0;
  const auto matches = Matches(options);
  int found = 0, triples = 0;
  for (std::size_t i = 0; i + 3 <= 300; i += 3, ++triples) {
    std::array<Eigen::Vector3d, 3> points, rays;
    for (std::size_t k = 0; k < 3; ++k) {
      points[k] = matches[i + k].point_in_world;
      rays[k] = matches[i + k].normalized.homogeneous().normalized();
    }
    for (const Rigid3d& pose : SolveP3p(points, rays)) {
      const bool near = RotationAngle(pose.rotation * kCamFromWorld.rotation.conjugate()) < 1e-5 &&
                        (pose.translation - kCamFromWorld.translation).norm() < 1e-4;
      found += near ? 1 : 0;
      for (std::size_t k = 0; k < 3; ++k) {  // every solution sees the points along the rays
        EXPECT_LT(((pose * points[k]).normalized() - rays[k]).norm(), 1e-6);
      }
    }
  }
  EXPECT_GE(found, triples - 2);
}

TEST(P3p, RefusesPointsOnALine) {
  const std::array<Eigen::Vector3d, 3> points{Eigen::Vector3d(0, 0, 4), Eigen::Vector3d(1, 0, 4),
                                              Eigen::Vector3d(2, 0, 4)};
  const std::array<Eigen::Vector3d, 3> rays{points[0].normalized(), points[1].normalized(),
                                            points[2].normalized()};
  EXPECT_TRUE(SolveP3p(points, rays).empty());
}

TEST(AbsolutePose, ExactMatchesGiveTheExactPose) {
  SyntheticSceneOptions options;
  options.noise_px = 0.0;
  const auto result = EstimateAbsolutePose(Matches(options), 500.0, {}, 1);
  ASSERT_TRUE(result);
  EXPECT_THAT(result->cam_from_world, Rigid3dNear(kCamFromWorld, 1e-6, 1e-6));
}

TEST(AbsolutePose, ToleratesSeventyPercentOutliers) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SyntheticSceneOptions options;
    options.outlier_ratio = 0.7;
    options.num_points = 300;
    options.seed = seed;
    const auto result = EstimateAbsolutePose(Matches(options), 500.0, {}, seed);
    ASSERT_TRUE(result);
    EXPECT_THAT(result->cam_from_world, Rigid3dNear(kCamFromWorld, 0.15, 0.03));
  }
}

TEST(AbsolutePose, MarksTheOutliers) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 0.3;
  const SyntheticScene scene = MakeSyntheticScene({kCamFromWorld}, options);
  const auto result = EstimateAbsolutePose(Matches(options), 500.0, {}, 1);
  ASSERT_TRUE(result);
  int agree = 0;
  for (std::size_t i = 0; i < result->is_inlier.size(); ++i) {
    agree += (result->is_inlier[i] != 0) != scene.observations[0][i].is_outlier ? 1 : 0;
  }
  EXPECT_GT(agree, 0.93 * static_cast<double>(result->is_inlier.size()));
}

TEST(AbsolutePose, ReturnsNothingForWrongOrFewMatches) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 1.0;
  EXPECT_FALSE(EstimateAbsolutePose(Matches(options), 500.0, {}, 1));
  options.outlier_ratio = 0.0;
  options.num_points = 8;
  EXPECT_FALSE(EstimateAbsolutePose(Matches(options), 500.0, {}, 1));
  EXPECT_FALSE(EstimateAbsolutePose({}, 500.0, {}, 1));
}

TEST(AbsolutePose, SurvivesIdenticalPoints) {
  const std::vector<PointMatch> matches(50, {{1.0, 2.0, 5.0}, {0.2, 0.4}, 1.0});
  EXPECT_FALSE(EstimateAbsolutePose(matches, 500.0, {}, 1));
}

}  // namespace
}  // namespace lift_slam
