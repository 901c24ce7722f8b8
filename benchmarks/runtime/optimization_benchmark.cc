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

}  // namespace
}  // namespace lift_slam
