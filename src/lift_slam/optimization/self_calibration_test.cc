#include "lift_slam/optimization/self_calibration.h"

#include <gtest/gtest.h>

#include <set>

#include "lift_slam/optimization/test_scene.h"

namespace lift_slam {
namespace {

// Cameras that move and turn before a cloud of points, seen through a camera that is off by
// `truth`.
BundleProblem MakeProblem(const CalibrationCorrection& truth, double sigma_px, Random& random) {
  BundleProblem problem;
  problem.intrinsics = TestIntrinsics();
  for (int i = 0; i < 400; ++i) {
    problem.points.push_back(
        {random.Uniform(-12.0, 12.0), random.Uniform(-4.0, 4.0), random.Uniform(6.0, 25.0)});
  }
  for (int k = 0; k < 12; ++k) {
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(0.05 * (k - 6), Eigen::Vector3d(0.2, 1.0, 0.1).normalized()));
    problem.cams_from_world.emplace_back(turn, Eigen::Vector3d(0.4 * k - 2.0, 0.1 * k, 0.2 * k));
    problem.is_camera_fixed.push_back(k == 0);
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d in_cam =
          problem.cams_from_world.back() * problem.points[static_cast<std::size_t>(i)];
      const Eigen::Vector2d ray = in_cam.head<2>() / in_cam.z();
      const Eigen::Vector2d seen = truth.focal_scale * (1.0 + truth.k1 * ray.squaredNorm()) * ray;
      const Eigen::Vector2d pixel = problem.intrinsics.Project({seen.x(), seen.y(), 1.0});
      if (pixel.x() < 0.0 || pixel.x() > 1240.0 || pixel.y() < 0.0 || pixel.y() > 375.0) continue;
      problem.observations.push_back({k, i, pixel + RandomVector(random, sigma_px).head<2>(), 1.0});
    }
  }
  return problem;
}

TEST(SelfCalibration, FindsWhatTheCalibrationIsOffBy) {
  Random random(3);
  const CalibrationCorrection truth{0.99, 0.012};
  BundleProblem problem = MakeProblem(truth, 0.3, random);
  const SelfCalibrationReport report = SelfCalibrate(problem, {});
  ASSERT_TRUE(report.usable());
  EXPECT_NEAR(report.correction().focal_scale, truth.focal_scale, 2e-3);
  EXPECT_NEAR(report.correction().k1, truth.k1, 2e-3);
  EXPECT_LT(report.final_cost, 0.5 * report.initial_cost);
}

TEST(SelfCalibration, LeavesARightCalibrationAlone) {
  Random random(4);
  BundleProblem problem = MakeProblem({}, 0.3, random);
  const SelfCalibrationReport report = SelfCalibrate(problem, {});
  ASSERT_TRUE(report.usable());
  EXPECT_NEAR(report.correction().focal_scale, 1.0, 2e-3);
  EXPECT_NEAR(report.correction().k1, 0.0, 2e-3);
}

TEST(SelfCalibration, PixelsBecomeThoseOfTheIdealPinhole) {
  Random random(5);
  BundleProblem problem = MakeProblem({1.01, -0.01}, 0.0, random);
  ASSERT_TRUE(SelfCalibrate(problem, {}).usable());
  for (const BundleObservation& observation : problem.observations) {
    const Eigen::Vector3d in_cam =
        problem.cams_from_world[static_cast<std::size_t>(observation.camera)] *
        problem.points[static_cast<std::size_t>(observation.point)];
    EXPECT_LT((problem.intrinsics.Project(in_cam) - observation.pixel).norm(), 0.1);
  }
}

TEST(SelfCalibration, CorrectionInvertsItsOwnModel) {
  const PinholeIntrinsics intrinsics = TestIntrinsics();
  const CalibrationCorrection correction{0.98, 0.02};
  const Eigen::Vector2d ideal(900.0, 60.0);
  const Eigen::Vector2d ray = intrinsics.Unproject(ideal).head<2>();
  const Eigen::Vector2d seen =
      correction.focal_scale * (1.0 + correction.k1 * ray.squaredNorm()) * ray;
  const Eigen::Vector2d measured = intrinsics.Project({seen.x(), seen.y(), 1.0});
  EXPECT_LT((correction.ToIdeal(intrinsics, measured) - ideal).norm(), 1e-9);
}

TEST(SelfCalibration, IsClearlyOffBeyondThreeErrors) {
  const SelfCalibrationOptions options{.focal_scale_error = 0.005, .k1_error = 0.002};
  EXPECT_FALSE(IsClearlyOff({}, options));
  EXPECT_FALSE(IsClearlyOff({0.9934, -0.0039}, options));
  EXPECT_TRUE(IsClearlyOff({0.9845, 0.0066}, options));
  EXPECT_TRUE(IsClearlyOff({1.016, 0.0}, options));
  EXPECT_TRUE(IsClearlyOff({1.0, -0.0062}, options));
}

TEST(SelfCalibration, NothingToSeeIsNotUsable) {
  BundleProblem problem;
  EXPECT_FALSE(SelfCalibrate(problem, {}).usable());
}

TEST(SelfCalibration, EveryRefusalHasANameAndAnExplanation) {
  std::set<std::string_view> names;
  for (int i = 0; i < static_cast<int>(CalibrationRefusal::kCount); ++i) {
    names.insert(Name(static_cast<CalibrationRefusal>(i)));
    EXPECT_FALSE(Explain(static_cast<CalibrationRefusal>(i)).empty());
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(CalibrationRefusal::kCount));
}

}  // namespace
}  // namespace lift_slam
