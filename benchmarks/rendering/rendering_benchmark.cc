// Pictures a second of the scene renderer: items_per_second. The time column is wall time, CPU is
// that of all threads of the process.
#include <benchmark/benchmark.h>

#include <atomic>
#include <thread>
#include <vector>

#include "lift_slam/simulation/rendering/scene_for_test.h"
#include "lift_slam/simulation/rendering/scene_renderer.h"

namespace lift_slam {
namespace {

constexpr int kFrames = 24;
constexpr int kHouses = 500;  // 46,000 triangles, a few more than a big race track

const Scene& BigStreet() {
  static const Scene scene = Street(kHouses, 1);
  return scene;
}

Rigid3d PoseOfFrame(int frame) { return LookingAlongX({100.0 + 40.0 * frame, 0.5, 1.65}); }

Camera KittiCamera() {
  Camera camera;
  camera.pinhole = {718.9, 718.9, 607.2, 185.2, 1241, 376};
  return camera;
}

Camera Fisheye() {
  Camera camera;
  camera.pinhole = {260.0, 260.0, 319.5, 239.5, 640, 480};
  camera.distortion = KannalaBrandt{-0.01, 0.01, -0.005, 0.001};
  return camera;
}

// Draws all frames with that many renderers, each in a thread of its own.
void DrawFrames(std::vector<std::unique_ptr<SceneRenderer>>& renderers) {
  std::atomic<int> next{0};
  std::vector<std::thread> threads;
  for (auto& renderer : renderers) {
    threads.emplace_back([&next, &renderer] {
      for (int frame = next++; frame < kFrames; frame = next++) {
        benchmark::DoNotOptimize(renderer->Render(PoseOfFrame(frame)));
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

void Run(benchmark::State& state, const Camera& camera, const RenderQuality& quality,
         int renderer_count) {
  std::vector<std::unique_ptr<SceneRenderer>> renderers;
  for (int i = 0; i < renderer_count; ++i) {
    renderers.push_back(std::make_unique<SceneRenderer>(BigStreet(), camera, quality));
    renderers.back()->Render(PoseOfFrame(0));  // compiles the shaders
  }
  for (auto _ : state) DrawFrames(renderers);
  state.SetItemsProcessed(state.iterations() * kFrames);
}

void BM_Kitti(benchmark::State& state) {
  RenderQuality quality;
  quality.supersampling = static_cast<int>(state.range(0));
  quality.anisotropy = static_cast<int>(state.range(1));
  Run(state, KittiCamera(), quality, static_cast<int>(state.range(2)));
}
BENCHMARK(BM_Kitti)
    ->ArgNames({"supersampling", "anisotropy", "renderers"})
    ->Args({1, 8, 1})
    ->Args({2, 1, 1})
    ->Args({2, 8, 1})
    ->Args({2, 8, 2})
    ->Args({2, 16, 2})
    ->Args({3, 8, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void BM_Fisheye(benchmark::State& state) {
  Run(state, Fisheye(), RenderQuality{}, RecommendedRendererThreads());
}
BENCHMARK(BM_Fisheye)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

void BM_Construction(benchmark::State& state) {
  for (auto _ : state) SceneRenderer(BigStreet(), KittiCamera(), RenderQuality{});
}
BENCHMARK(BM_Construction)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
}  // namespace lift_slam
