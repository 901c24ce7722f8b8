#include "lift_slam/optimization/pose_optimization.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <numeric>

#include "lift_slam/optimization/test_scene.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

TEST(OptimizePose, RecoversThePoseExactlyWithoutNoise) {
  Random random(1);
  const PoseScene scene = MakePoseScene({.num_points = 100}, random);
  const Rigid3d initial = Perturb(scene.cam_from_world, random, 0.03, 0.5);
  const auto result = OptimizePose(scene.intrinsics, initial, scene.observations);
  const auto [distance, angle] = PoseDifference(result.cam_from_world, scene.cam_from_world);
  EXPECT_LT(distance, 1e-6);
  EXPECT_LT(angle, 1e-8);
  EXPECT_EQ(result.num_inliers, 100);
}

TEST(OptimizePose, FindsOutliersAndThePoseAmongThem) {
  Random random(2);
  const PoseScene scene =
      MakePoseScene({.num_points = 600, .sigma_px = 1.0, .outlier_share = 0.3}, random);
  const Rigid3d initial = Perturb(scene.cam_from_world, random, 0.01, 0.3);
  const auto result = OptimizePose(scene.intrinsics, initial, scene.observations);
  const auto [distance, angle] = PoseDifference(result.cam_from_world, scene.cam_from_world);
  EXPECT_LT(distance, 0.03);
  EXPECT_LT(angle, 0.0005);
  int missed_outliers = 0, lost_inliers = 0, num_outliers = 0;
  for (std::size_t i = 0; i < scene.is_outlier.size(); ++i) {
    num_outliers += scene.is_outlier[i];
    missed_outliers += scene.is_outlier[i] && result.is_inlier[i];
    lost_inliers += !scene.is_outlier[i] && !result.is_inlier[i];
  }
  EXPECT_GT(num_outliers, 150);
  EXPECT_LE(missed_outliers, 1);
  EXPECT_LT(lost_inliers, 0.08 * (600 - num_outliers));  // 5 % by the chi-square level
  EXPECT_EQ(result.num_inliers,
            std::accumulate(result.is_inlier.begin(), result.is_inlier.end(), 0));
}

TEST(OptimizePose, FindsThePoseFromFewObservationsWithManyOutliers) {
  Random random(11);
  int found = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const PoseScene scene =
        MakePoseScene({.num_points = 40, .sigma_px = 1.0, .outlier_share = 0.4}, random);
    const Rigid3d initial = Perturb(scene.cam_from_world, random, 0.02, 0.2);
    const auto result = OptimizePose(scene.intrinsics, initial, scene.observations);
    const auto [distance, angle] = PoseDifference(result.cam_from_world, scene.cam_from_world);
    found += distance < 0.15 && angle < 0.002;
  }
  EXPECT_GE(found, 88);  // 83 without the wider limits of the first rounds
}

TEST(OptimizePose, APriorHoldsTheCenterWhereTheImageSaysLittleAndYieldsWhereItSaysMuch) {
  Random random(4);
  PoseScene scene = MakePoseScene({.num_points = 100, .sigma_px = 1.0}, random);
  const Eigen::Vector3d truth = scene.cam_from_world.TargetOriginInSource();
  const CenterPrior wrong{truth + Eigen::Vector3d(0.3, 0.0, 0.0), 1.0 / (0.1 * 0.1)};
  const auto distance = [&] {
    const auto result =
        OptimizePose(scene.intrinsics, scene.cam_from_world, scene.observations, {}, wrong);
    return (result.cam_from_world.TargetOriginInSource() - truth).norm();
  };
  EXPECT_LT(distance(), 0.05);
  for (PoseObservation& observation : scene.observations) {  // the same directions, far away
    observation.point_in_world = truth + 1000.0 * (observation.point_in_world - truth);
  }
  EXPECT_NEAR(distance(), 0.3, 0.01);
}

TEST(OptimizePose, WeightsObservationsByTheirVariance) {
  Random random(3);
  PoseScene scene = MakePoseScene({.num_points = 200}, random);
  for (std::size_t i = 0; i < 200; i += 2) {  // half are 10 times as uncertain, and all right
    scene.observations[i].pixel += Eigen::Vector2d(8.0, 0.0);
    scene.observations[i].inverse_variance = 0.01;
  }
  const auto result = OptimizePose(scene.intrinsics, scene.cam_from_world, scene.observations);
  EXPECT_EQ(result.num_inliers, 200);
  // The mean shift in the image is weighted down to 8 px * 0.01 / 1.01.
  const auto [distance, angle] = PoseDifference(result.cam_from_world, scene.cam_from_world);
  EXPECT_LT(angle, 2.0 * 8.0 * 0.01 / scene.intrinsics.fx);
}

TEST(OptimizePose, TakesBackObservationsThatAPoorStartRejected) {
  Random random(4);
  const PoseScene scene = MakePoseScene({.num_points = 300, .sigma_px = 0.5}, random);
  const Rigid3d initial = Perturb(scene.cam_from_world, random, 0.05, 1.0);
  const auto at_start = OptimizePose(scene.intrinsics, initial, scene.observations,
                                     {.rounds = 1, .iterations_per_round = 1});
  const auto result = OptimizePose(scene.intrinsics, initial, scene.observations);
  EXPECT_LT(at_start.num_inliers, 250);
  EXPECT_GT(result.num_inliers, 290);
}

TEST(OptimizePose, PointsBehindTheCameraAreOutliers) {
  Random random(5);
  PoseScene scene = MakePoseScene({.num_points = 50}, random);
  const Rigid3d world_from_cam = Inverse(scene.cam_from_world);
  for (std::size_t i = 0; i < 10; ++i) {  // mirrored: the same pixel, from behind
    auto& x_in_world = scene.observations[i].point_in_world;
    x_in_world = world_from_cam * (-(scene.cam_from_world * x_in_world));
  }
  const auto result = OptimizePose(scene.intrinsics, scene.cam_from_world, scene.observations);
  EXPECT_EQ(result.num_inliers, 40);
  for (std::size_t i = 0; i < 50; ++i) EXPECT_EQ(result.is_inlier[i], i >= 10);
}

TEST(OptimizePose, NonFiniteObservationsAreOutliers) {
  Random random(6);
  PoseScene scene = MakePoseScene({.num_points = 50}, random);
  scene.observations[3].pixel.x() = std::numeric_limits<double>::quiet_NaN();
  scene.observations[4].point_in_world.y() = std::numeric_limits<double>::infinity();
  const Rigid3d initial = Perturb(scene.cam_from_world, random, 0.01, 0.1);
  const auto result = OptimizePose(scene.intrinsics, initial, scene.observations);
  EXPECT_EQ(result.num_inliers, 48);
  EXPECT_FALSE(result.is_inlier[3] || result.is_inlier[4]);
}

TEST(OptimizePose, ReturnsTheInitialPoseWithoutEnoughObservations) {
  Random random(7);
  const PoseScene scene = MakePoseScene({.num_points = 2}, random);
  for (const std::size_t count : {0, 1, 2}) {
    const auto result = OptimizePose(scene.intrinsics, scene.cam_from_world,
                                     std::span(scene.observations).first(count));
    EXPECT_EQ(result.is_inlier.size(), count);
    EXPECT_EQ(result.num_inliers, static_cast<int>(count));
    EXPECT_EQ(PoseDifference(result.cam_from_world, scene.cam_from_world).first, 0.0);
  }
}

TEST(OptimizePose, ReturnsTheInitialPoseWhenAllAreOutliers) {
  Random random(8);
  const PoseScene scene = MakePoseScene({.num_points = 40, .outlier_share = 1.0}, random);
  const auto result = OptimizePose(scene.intrinsics, scene.cam_from_world, scene.observations,
                                   {.max_squared_error = 1e-3});
  EXPECT_EQ(result.num_inliers, 0);
  EXPECT_EQ(PoseDifference(result.cam_from_world, scene.cam_from_world).first, 0.0);
}

TEST(OptimizePose, SurvivesPointsInOnePlace) {
  Random random(9);
  PoseScene scene = MakePoseScene({.num_points = 20, .sigma_px = 1.0}, random);
  for (auto& observation : scene.observations) observation = scene.observations[0];
  const auto result = OptimizePose(scene.intrinsics, scene.cam_from_world, scene.observations);
  EXPECT_TRUE(result.cam_from_world.translation.allFinite());
  EXPECT_TRUE(result.cam_from_world.rotation.coeffs().allFinite());
  EXPECT_EQ(result.num_inliers, 20);
}

TEST(OptimizePose, SameInputSameBits) {
  Random random(10);
  const PoseScene scene = MakePoseScene({.sigma_px = 1.0, .outlier_share = 0.2}, random);
  const Rigid3d initial = Perturb(scene.cam_from_world, random, 0.01, 0.1);
  const auto first = OptimizePose(scene.intrinsics, initial, scene.observations);
  const auto second = OptimizePose(scene.intrinsics, initial, scene.observations);
  EXPECT_EQ(first.cam_from_world.translation, second.cam_from_world.translation);
  EXPECT_EQ(first.cam_from_world.rotation.coeffs(), second.cam_from_world.rotation.coeffs());
  EXPECT_EQ(first.is_inlier, second.is_inlier);
}

TEST(OptimizePose, RefusesOptionsWithoutRounds) {
  EXPECT_THROW(OptimizePose(TestIntrinsics(), Rigid3d(), {}, {.rounds = 0}), CheckError);
}

}  // namespace
}  // namespace lift_slam
