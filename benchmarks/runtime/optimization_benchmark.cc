#include <benchmark/benchmark.h>

#include "lift_slam/optimization/pose_optimization.h"
#include "lift_slam/optimization/test_scene.h"

namespace lift_slam {
namespace {

// Argument: number of observations; 1 px noise, 15 % outliers, a start half a degree off.
void BM_OptimizePose(benchmark::State& state) {
  Random random(1);
  const PoseScene scene = MakePoseScene(
      {.num_points = static_cast<int>(state.range(0)), .sigma_px = 1.0, .outlier_share = 0.15},
      random);
  const Rigid3d initial = Perturb(scene.cam_from_world, random, 0.01, 0.2);
  int inliers = 0;
  for (auto _ : state) {
    inliers = OptimizePose(scene.intrinsics, initial, scene.observations).num_inliers;
  }
  state.counters["inliers"] = inliers;
}
BENCHMARK(BM_OptimizePose)->Arg(300)->Arg(500)->Arg(1500)->Unit(benchmark::kMicrosecond);

// Arguments: free cameras, fixed cameras, points, observations a point (at most), solver
// (BundleSolverKind), threads; 1 px noise and 5 % outliers. The start is as far off as after
// tracking and triangulation.
void BM_SolveBundle(benchmark::State& state) {
  const auto argument = [&](int i) { return static_cast<int>(state.range(i)); };
  Random random(1);
  const BundleScene scene = MakeBundleScene({.num_free_cameras = argument(0),
                                             .num_fixed_cameras = argument(1),
                                             .num_points = argument(2),
                                             .observations_per_point = argument(3),
                                             .sigma_px = 1.0,
                                             .outlier_share = 0.05},
                                            random);
  const BundleOptions options = {.solver = static_cast<BundleSolverKind>(argument(4)),
                                 .num_threads = argument(5)};
  BundleReport report;
  for (auto _ : state) {
    BundleProblem problem = scene.problem;
    report = SolveBundle(problem, options);
  }
  state.counters["observations"] = static_cast<double>(scene.problem.observations.size());
  state.counters["iterations"] = report.iterations;
  state.counters["cost"] = report.final_cost;
}
constexpr int kCeres = static_cast<int>(BundleSolverKind::kCeres);
constexpr int kReduced = static_cast<int>(BundleSolverKind::kReduced);
BENCHMARK(BM_SolveBundle)
    ->Args({20, 20, 3000, 5, kReduced, 1})
    ->Args({20, 20, 3000, 5, kCeres, 1})
    ->Args({20, 20, 3000, 5, kCeres, 2})
    ->Args({25, 40, 4000, 10, kReduced, 1})
    ->Args({25, 40, 4000, 10, kCeres, 1})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lift_slam
