#include "lift_slam/testing/synthetic_scene.h"

#include <gtest/gtest.h>

#include "lift_slam/testing/rigid3_matchers.h"

namespace lift_slam {
namespace {

const std::vector<Rigid3d> kTwoCameras{Rigid3d(),
                                       {Eigen::Quaterniond::Identity(), {-0.5, 0.0, 0.0}}};

TEST(SyntheticScene, ObservationsAreProjections) {
  SyntheticSceneOptions options;
  options.noise_px = 0.0;
  const SyntheticScene scene = MakeSyntheticScene(kTwoCameras, options);
  ASSERT_EQ(scene.observations.size(), 2U);
  EXPECT_GT(scene.observations[1].size(), 400U);
  for (const SyntheticObservation& observation : scene.observations[1]) {
    const Eigen::Vector3d& point = scene.points[static_cast<std::size_t>(observation.point)];
    const Eigen::Vector2d pixel = scene.pinhole.Project(kTwoCameras[1] * point);
    EXPECT_LT((observation.pixel - pixel).norm(), 1e-9);
  }
}

TEST(SyntheticScene, HasTheOutliersAskedFor) {
  SyntheticSceneOptions options;
  options.outlier_ratio = 0.3;
  const SyntheticScene scene = MakeSyntheticScene(kTwoCameras, options);
  int outliers = 0;
  for (const auto& observation : scene.observations[0]) outliers += observation.is_outlier ? 1 : 0;
  EXPECT_NEAR(outliers, 150, 40);
}

TEST(SyntheticScene, PlaneIsAPlane) {
  SyntheticSceneOptions options;
  options.shape = SyntheticShape::kPlane;
  const SyntheticScene scene = MakeSyntheticScene(kTwoCameras, options);
  const Eigen::Vector3d normal =
      (scene.points[1] - scene.points[0]).cross(scene.points[2] - scene.points[0]).normalized();
  for (const Eigen::Vector3d& point : scene.points) {
    EXPECT_NEAR(normal.dot(point - scene.points[0]), 0.0, 1e-6);
  }
}

TEST(SyntheticScene, SameSeedSameScene) {
  const SyntheticScene a = MakeSyntheticScene(kTwoCameras, {});
  const SyntheticScene b = MakeSyntheticScene(kTwoCameras, {});
  SyntheticSceneOptions other;
  other.seed = 2;
  const SyntheticScene c = MakeSyntheticScene(kTwoCameras, other);
  EXPECT_EQ(a.observations[1][5].pixel, b.observations[1][5].pixel);
  EXPECT_NE(a.points[0], c.points[0]);
}

TEST(Rigid3dNear, AcceptsWithinAndRefusesBeyondTolerance) {
  const Rigid3d pose(Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY())),
                     {0.0, 0.1, 0.0});
  EXPECT_THAT(pose, Rigid3dNear(Rigid3d(), 0.6, 0.11));
  EXPECT_THAT(pose, testing::Not(Rigid3dNear(Rigid3d(), 0.5, 0.11)));
  EXPECT_THAT(pose, testing::Not(Rigid3dNear(Rigid3d(), 0.6, 0.09)));
}

}  // namespace
}  // namespace lift_slam
