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

// Arguments: free cameras, fixed cameras, points, threads; 5 observations a point, 1 px noise and 5
// % outliers. The start is as far off as after tracking and triangulation.
void BM_SolveBundle(benchmark::State& state) {
  Random random(1);
  const BundleScene scene =
      MakeBundleScene({.num_free_cameras = static_cast<int>(state.range(0)),
                       .num_fixed_cameras = static_cast<int>(state.range(1)),
                       .num_points = static_cast<int>(state.range(2)),
                       .observations_per_point = static_cast<int>(state.range(3)),
                       .sigma_px = 1.0,
                       .outlier_share = 0.05},
                      random);
  int iterations = 0;
  double cost = 0;
  for (auto _ : state) {
    BundleProblem problem = scene.problem;
    const BundleReport report =
        SolveBundle(problem, {.solver = static_cast<BundleSolverKind>(state.range(4)),
                              .num_threads = static_cast<int>(state.range(5))});
    iterations = report.iterations;
    cost = report.final_cost;
  }
  state.counters["observations"] = static_cast<double>(scene.problem.observations.size());
  state.counters["iterations"] = iterations;
  state.counters["cost"] = cost;
}
BENCHMARK(BM_SolveBundle)
    ->Args({20, 20, 3000, 5, 1, 1})
    ->Args({20, 20, 3000, 5, 1, 2})
    ->Args({20, 20, 3000, 5, 2, 1})
    ->Args({20, 20, 3000, 10, 1, 1})
    ->Args({20, 20, 3000, 10, 2, 1})
    ->Args({40, 20, 3000, 10, 1, 1})
    ->Args({40, 20, 3000, 10, 2, 1})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lift_slam
