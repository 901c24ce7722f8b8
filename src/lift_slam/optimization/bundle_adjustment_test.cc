#include "lift_slam/optimization/bundle_adjustment.h"

#include <gtest/gtest.h>

#include <limits>

#include "lift_slam/optimization/test_scene.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

double LargestCentreError(const BundleScene& scene, const BundleProblem& problem) {
  double largest = 0.0;
  for (std::size_t i = 0; i < scene.cams_from_world.size(); ++i) {
    largest = std::max(largest,
                       PoseDifference(scene.cams_from_world[i], problem.cams_from_world[i]).first);
  }
  return largest;
}

double MedianPointError(const BundleScene& scene, const BundleProblem& problem) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    errors.push_back((scene.points[i] - problem.points[i]).norm());
  }
  std::nth_element(errors.begin(), errors.begin() + static_cast<long>(errors.size() / 2),
                   errors.end());
  return errors[errors.size() / 2];
}

void ExpectSame(const BundleProblem& a, const BundleProblem& b) {
  for (std::size_t i = 0; i < a.cams_from_world.size(); ++i) {
    EXPECT_EQ(a.cams_from_world[i].rotation.coeffs(), b.cams_from_world[i].rotation.coeffs());
    EXPECT_EQ(a.cams_from_world[i].translation, b.cams_from_world[i].translation);
  }
  for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(a.points[i], b.points[i]);
}

int Count(const std::vector<char>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), char{1}));
}

class SolveBundleTest : public testing::TestWithParam<BundleSolverKind> {};

INSTANTIATE_TEST_SUITE_P(BothSolvers, SolveBundleTest,
                         testing::Values(BundleSolverKind::kCeres, BundleSolverKind::kReduced),
                         [](const auto& kind) {
                           return kind.param == BundleSolverKind::kCeres ? "Ceres" : "Reduced";
                         });

TEST_P(SolveBundleTest, RecoversPosesAndPointsExactlyWithoutNoise) {
  Random random(1);
  const BundleScene scene = MakeBundleScene({}, random);
  BundleProblem problem = scene.problem;
  const BundleReport report = SolveBundle(
      problem, {.solver = GetParam(), .plain_iterations = 30, .function_tolerance = 1e-12});
  EXPECT_TRUE(report.usable) << report.message;
  EXPECT_LT(report.final_cost, 1e-9);
  EXPECT_GT(report.initial_cost, 1000.0);
  EXPECT_LT(LargestCentreError(scene, problem), 1e-6);
  EXPECT_LT(MedianPointError(scene, problem), 1e-5);
  EXPECT_EQ(report.is_inlier, std::vector<char>(problem.observations.size(), 1));
}

TEST_P(SolveBundleTest, FixedCamerasDoNotMove) {
  Random random(2);
  const BundleScene scene = MakeBundleScene({.num_fixed_cameras = 3, .sigma_px = 2.0}, random);
  BundleProblem problem = scene.problem;
  ASSERT_TRUE(SolveBundle(problem, {.solver = GetParam()}).usable);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(problem.cams_from_world[i].rotation.coeffs(),
              scene.cams_from_world[i].rotation.coeffs());
    EXPECT_EQ(problem.cams_from_world[i].translation, scene.cams_from_world[i].translation);
  }
  EXPECT_GT((problem.cams_from_world[4].translation - scene.problem.cams_from_world[4].translation)
                .norm(),
            1e-3);
}

TEST_P(SolveBundleTest, FindsOutliersAndTheGeometryAmongThem) {
  Random random(3);
  const BundleScene scene =
      MakeBundleScene({.num_points = 600, .sigma_px = 1.0, .outlier_share = 0.1}, random);
  BundleProblem problem = scene.problem;
  const BundleReport report = SolveBundle(problem, {.solver = GetParam()});
  ASSERT_TRUE(report.usable) << report.message;
  EXPECT_LT(LargestCentreError(scene, problem), 0.03);
  int missed_outliers = 0, lost_inliers = 0;
  for (std::size_t i = 0; i < scene.is_outlier.size(); ++i) {
    missed_outliers += scene.is_outlier[i] && report.is_inlier[i];
    lost_inliers += !scene.is_outlier[i] && !report.is_inlier[i];
  }
  const int num_outliers = Count(scene.is_outlier);
  EXPECT_GT(num_outliers, 150);
  // A point seen twice takes an outlier along its epipolar line for true.
  EXPECT_LT(missed_outliers, 0.1 * num_outliers);
  EXPECT_LT(lost_inliers, 0.1 * static_cast<double>(scene.is_outlier.size()));
}

TEST_P(SolveBundleTest, AdjustsAStructureSeenByFixedCamerasOnly) {
  Random random(4);
  const BundleScene scene =
      MakeBundleScene({.num_free_cameras = 0, .num_fixed_cameras = 5}, random);
  BundleProblem problem = scene.problem;
  const BundleReport report = SolveBundle(
      problem, {.solver = GetParam(), .plain_iterations = 30, .function_tolerance = 1e-12});
  EXPECT_TRUE(report.usable) << report.message;
  EXPECT_LT(MedianPointError(scene, problem), 1e-5);
}

TEST_P(SolveBundleTest, AdjustsManyCameras) {
  Random random(5);
  const BundleScene scene = MakeBundleScene(
      {.num_free_cameras = 70, .num_points = 1500, .start_rad = 0.0005, .start_map_units = 0.01},
      random);
  BundleProblem problem = scene.problem;
  const BundleReport report = SolveBundle(
      problem, {.solver = GetParam(), .plain_iterations = 30, .function_tolerance = 1e-12});
  EXPECT_TRUE(report.usable) << report.message;
  EXPECT_LT(LargestCentreError(scene, problem), 1e-5);
}

TEST_P(SolveBundleTest, WorksWithoutFixedCameras) {
  Random random(6);
  const BundleScene scene = MakeBundleScene({.num_fixed_cameras = 0}, random);
  BundleProblem problem = scene.problem;
  const BundleReport report =
      SolveBundle(problem, {.solver = GetParam(), .function_tolerance = 1e-9});
  EXPECT_TRUE(report.usable) << report.message;
  EXPECT_LT(report.final_cost, 1e-6);
}

TEST_P(SolveBundleTest, PointsBehindTheirCamerasAreOutliers) {
  Random random(7);
  BundleScene scene = MakeBundleScene({}, random);
  BundleProblem problem = scene.problem;
  problem.points[0] = {0.0, 0.0, -30.0};  // behind all cameras
  const BundleReport report = SolveBundle(problem, {.solver = GetParam()});
  EXPECT_TRUE(report.usable) << report.message;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    EXPECT_EQ(report.is_inlier[i], problem.observations[i].point != 0) << i;
  }
  EXPECT_EQ(problem.points[0], Eigen::Vector3d(0.0, 0.0, -30.0));
}

TEST_P(SolveBundleTest, NonFiniteObservationIsAnOutlier) {
  Random random(8);
  BundleScene scene = MakeBundleScene({}, random);
  BundleProblem problem = scene.problem;
  problem.observations[5].pixel.y() = kNan;
  const BundleReport report = SolveBundle(problem, {.solver = GetParam()});
  EXPECT_TRUE(report.usable) << report.message;
  EXPECT_EQ(Count(report.is_inlier), static_cast<int>(problem.observations.size()) - 1);
  EXPECT_LT(LargestCentreError(scene, problem), 1e-3);
}

TEST_P(SolveBundleTest, LeavesTheProblemWithoutObservationsAlone) {
  Random random(9);
  BundleScene scene = MakeBundleScene({}, random);
  scene.problem.observations.clear();
  BundleProblem problem = scene.problem;
  const BundleReport report = SolveBundle(problem, {.solver = GetParam()});
  EXPECT_FALSE(report.usable);
  EXPECT_FALSE(report.message.empty());
  ExpectSame(problem, scene.problem);
}

TEST_P(SolveBundleTest, LeavesTheProblemOfOutliersAlone) {
  Random random(10);
  const BundleScene scene = MakeBundleScene({.sigma_px = 50.0}, random);
  BundleProblem problem = scene.problem;
  const BundleReport report =
      SolveBundle(problem, {.solver = GetParam(), .max_squared_error = 1e-9});
  EXPECT_FALSE(report.usable);
  EXPECT_EQ(Count(report.is_inlier), 0);
  ExpectSame(problem, scene.problem);
}

TEST_P(SolveBundleTest, LeavesANonFiniteProblemAlone) {
  Random random(11);
  BundleScene scene = MakeBundleScene({}, random);
  for (const bool bad_point : {false, true}) {
    BundleProblem problem = scene.problem;
    (bad_point ? problem.points[3] : problem.cams_from_world[4].translation).x() = kNan;
    const BundleReport report = SolveBundle(problem, {.solver = GetParam()});
    EXPECT_FALSE(report.usable);
    EXPECT_EQ(problem.points[7], scene.problem.points[7]);
  }
}

TEST_P(SolveBundleTest, SameInputSameBits) {
  Random random(12);
  const BundleScene scene = MakeBundleScene({.sigma_px = 1.0, .outlier_share = 0.1}, random);
  BundleProblem first = scene.problem, second = scene.problem;
  const BundleReport first_report = SolveBundle(first, {.solver = GetParam()}),
                     second_report = SolveBundle(second, {.solver = GetParam()});
  ExpectSame(first, second);
  EXPECT_EQ(first_report.is_inlier, second_report.is_inlier);
  EXPECT_EQ(first_report.final_cost, second_report.final_cost);
}

TEST_P(SolveBundleTest, RefusesIndicesOutOfRange) {
  Random random(13);
  BundleProblem problem = MakeBundleScene({}, random).problem;
  problem.observations[0].camera = 8;
  EXPECT_THROW(SolveBundle(problem, {.solver = GetParam()}), CheckError);
  problem.observations[0].camera = 0;
  problem.observations[0].point = -1;
  EXPECT_THROW(SolveBundle(problem, {.solver = GetParam()}), CheckError);
}

TEST_P(SolveBundleTest, AdjustsTwoViewsFromARoughStart) {
  Random random(14);
  const BundleScene scene = MakeBundleScene({.num_free_cameras = 1,
                                             .num_fixed_cameras = 1,
                                             .observations_per_point = 2,
                                             .sigma_px = 0.7,
                                             .start_rad = 0.02,
                                             .start_map_units = 0.1,
                                             .start_depth_share = 0.3},
                                            random);
  BundleProblem problem = scene.problem;
  const BundleReport report =
      SolveBundle(problem, {.solver = GetParam(), .robust_iterations = 20, .plain_iterations = 20});
  ASSERT_TRUE(report.usable) << report.message;
  EXPECT_GT(Count(report.is_inlier), 0.97 * static_cast<double>(report.is_inlier.size()));
  // One fixed camera leaves the scale free: compare directions.
  const Eigen::Vector3d found = problem.cams_from_world[1].translation.normalized();
  EXPECT_GT(found.dot(scene.cams_from_world[1].translation.normalized()), 0.999);
}

TEST(SolveBundle, BothSolversFindTheSameMinimum) {
  Random random(15);
  const BundleScene scene = MakeBundleScene({.sigma_px = 1.0}, random);
  BundleProblem ceres_problem = scene.problem, reduced_problem = scene.problem;
  // Without outliers beyond the limit, so that both keep the same observations.
  BundleOptions options = {.robust_iterations = 30,
                           .plain_iterations = 30,
                           .max_squared_error = 1e4,
                           .function_tolerance = 1e-12};
  options.solver = BundleSolverKind::kCeres;
  const BundleReport ceres_report = SolveBundle(ceres_problem, options);
  options.solver = BundleSolverKind::kReduced;
  const BundleReport reduced_report = SolveBundle(reduced_problem, options);
  EXPECT_NEAR(reduced_report.initial_cost, ceres_report.initial_cost,
              1e-9 * ceres_report.initial_cost);
  EXPECT_NEAR(reduced_report.final_cost, ceres_report.final_cost, 1e-6 * ceres_report.final_cost);
  for (std::size_t i = 0; i < scene.cams_from_world.size(); ++i) {
    EXPECT_LT(
        PoseDifference(ceres_problem.cams_from_world[i], reduced_problem.cams_from_world[i]).first,
        1e-4);
  }
}

TEST_P(SolveBundleTest, StopsAtTheTimeLimit) {
  Random random(16);
  const BundleScene scene = MakeBundleScene({}, random);
  BundleProblem problem = scene.problem;
  const BundleReport report = SolveBundle(problem, {.solver = GetParam(), .max_time_s = 1e-9});
  EXPECT_GT(report.final_cost, 0.01 * report.initial_cost);
}

}  // namespace
}  // namespace lift_slam
