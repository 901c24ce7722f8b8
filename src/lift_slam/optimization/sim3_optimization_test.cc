#include "lift_slam/optimization/sim3_optimization.h"

#include <gtest/gtest.h>

#include "lift_slam/optimization/cost_functions/sim3_reprojection_cost.h"
#include "lift_slam/optimization/so3.h"
#include "lift_slam/testing/sim3_scene.h"

namespace lift_slam {
namespace {

std::vector<Sim3Observation> Observations(const Sim3Scene& scene) {
  std::vector<Sim3Observation> observations;
  for (const Sim3SceneMatch& m : scene.matches) {
    observations.push_back({m.point_in_cam1, m.point_in_cam2, m.pixel1, m.pixel2, 1.0, 1.0});
  }
  return observations;
}

Sim3d Disturbed(const Sim3d& similarity, double scale) {
  return Sim3d(scale, ExpSo3({0.01, -0.02, 0.015}), {0.1, -0.1, 0.2}) * similarity;
}

Sim3OptimizationResult Optimize(const Sim3Scene& scene, const Sim3d& initial,
                                ScaleFit fit = ScaleFit::kFree) {
  return OptimizeSim3(scene.pinhole, scene.pinhole, initial, Observations(scene), fit);
}

double Angle(const Sim3d& a, const Sim3d& b) {
  return RotationAngle(a.rotation * b.rotation.conjugate());
}

TEST(Sim3ReprojectionCost, AScaleFarAstrayIsRefusedNotEvaluatedToNan) {
  const PinholeIntrinsics pinhole{400.0, 400.0, 320.0, 240.0, 640, 480};
  const Sim3d base{1.0, Eigen::Quaterniond::Identity(), Eigen::Vector3d::Zero()};
  const Sim3ReprojectionCost cost(pinhole, base, Sim3ReprojectionCost::Direction::kBackward,
                                  {0.1, 0.2, 3.0}, {330.0, 250.0}, 1.0);
  double residuals[2];
  double change[kSim3Parameters] = {};
  EXPECT_TRUE(cost(change, residuals));
  for (const double log_scale : {-77827.0, -21.0, 21.0, 1e5}) {
    change[kLogScaleParameter] = log_scale;
    EXPECT_FALSE(cost(change, residuals)) << log_scale;
  }
}

TEST(OptimizeSim3, RecoversTheSimilarityExactlyWithoutNoise) {
  const Sim3Scene scene = MakeSim3Scene({.noise_px = 0.0});
  const auto result = Optimize(scene, Disturbed(scene.cam1_from_cam2, 1.05));
  EXPECT_NEAR(result.cam1_from_cam2.scale, 2.5, 1e-6);
  EXPECT_LT(Angle(result.cam1_from_cam2, scene.cam1_from_cam2), 1e-7);
  EXPECT_LT((result.cam1_from_cam2.translation - scene.cam1_from_cam2.translation).norm(), 1e-6);
  EXPECT_EQ(result.num_inliers, 200);
}

TEST(OptimizeSim3, FindsOutliersAndTheSimilarityAmongThem) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Sim3Scene scene =
        MakeSim3Scene({.depth_noise = 0.005, .outlier_ratio = 0.3, .seed = seed});
    const auto result = Optimize(scene, Disturbed(scene.cam1_from_cam2, 1.05));
    EXPECT_NEAR(result.cam1_from_cam2.scale, 2.5, 0.01);
    EXPECT_LT(Angle(result.cam1_from_cam2, scene.cam1_from_cam2), 0.002);
    for (std::size_t i = 0; i < scene.matches.size(); ++i) {
      EXPECT_FALSE(scene.matches[i].is_outlier && result.is_inlier[i]) << i;
    }
    EXPECT_GE(result.num_inliers, 110);
  }
}

TEST(OptimizeSim3, IsBetterThanWhereItBegan) {
  const Sim3Scene scene = MakeSim3Scene({.depth_noise = 0.01});
  const Sim3d initial = Disturbed(scene.cam1_from_cam2, 1.02);
  const auto result = Optimize(scene, initial);
  EXPECT_LT(Angle(result.cam1_from_cam2, scene.cam1_from_cam2),
            0.1 * Angle(initial, scene.cam1_from_cam2));
}

// Where both cameras stand at one place, images say nothing of the scale; depths do.
TEST(OptimizeSim3, DepthsGiveTheScaleWhereTheCamerasCoincide) {
  const Sim3Scene scene = MakeSim3Scene({.depth_noise = 0.05, .outlier_ratio = 0.3, .offset = 0.0});
  const Sim3d initial = Disturbed(scene.cam1_from_cam2, 1.2);
  const auto scale_with = [&](double log_depth_sigma) {
    std::vector<Sim3Observation> observations = Observations(scene);
    for (Sim3Observation& o : observations) o.log_depth_sigma = log_depth_sigma;
    return OptimizeSim3(scene.pinhole, scene.pinhole, initial, observations).cam1_from_cam2.scale;
  };
  EXPECT_NEAR(scale_with(0.07), 2.5, 0.05);
  EXPECT_GT(std::abs(scale_with(0.0) - 2.5), 0.1);
}

TEST(OptimizeSim3, FixedScaleStaysAsItWas) {
  const Sim3Scene scene = MakeSim3Scene({.scale = 1.0});
  const auto result = Optimize(scene, Disturbed(scene.cam1_from_cam2, 1.0), ScaleFit::kFixed);
  EXPECT_DOUBLE_EQ(result.cam1_from_cam2.scale, 1.0);
  EXPECT_LT(Angle(result.cam1_from_cam2, scene.cam1_from_cam2), 0.001);
}

TEST(OptimizeSim3, TooFewMatchesLeaveTheInitialSimilarity) {
  Sim3Scene scene = MakeSim3Scene({});
  scene.matches.resize(2);
  const auto result = Optimize(scene, scene.cam1_from_cam2);
  EXPECT_EQ(result.cam1_from_cam2.translation, scene.cam1_from_cam2.translation);
  EXPECT_EQ(result.is_inlier.size(), 2U);
  EXPECT_EQ(Optimize(Sim3Scene{scene.pinhole, {}, {}}, {}).num_inliers, 0);
}

}  // namespace
}  // namespace lift_slam
