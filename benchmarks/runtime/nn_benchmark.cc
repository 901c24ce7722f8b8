// The networks of LIFT with random weights: 1000 patches, and the detector on an image of KITTI's
// size. Argument: threads (of the team; OpenMP starts none).
#include <benchmark/benchmark.h>

#include <string>

#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/lift/patch_sampling.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kNumPatches = 1000;
constexpr std::size_t kPatchBytes = std::size_t{kLiftPatchSize} * kLiftPatchSize;

std::vector<std::uint8_t> RandomPixels(std::size_t count) {
  Random random(1);
  std::vector<std::uint8_t> pixels(count);
  for (std::uint8_t& v : pixels) v = static_cast<std::uint8_t>(random.UniformInt(0, 255));
  return pixels;
}

GrayImage RandomImage(int width, int height) {
  auto pixels = RandomPixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  return GrayImage(cv::Mat(height, width, CV_8UC1, pixels.data()).clone());
}

void BM_Describe1000(benchmark::State& state, LiftTopology topology, nn::Precision precision) {
  LiftWeights weights = RandomLiftWeights(topology, 1, /*with_orientation=*/false);
  weights.descriptor_ranges = {2.0F, 4.0F, 4.0F};
  LiftNetworks networks(weights,
                        {.precision = precision, .num_threads = static_cast<int>(state.range(0))});
  if (networks.precision().used != precision) {
    return state.SkipWithError(networks.precision().reason.c_str());
  }
  const auto patches = RandomPixels(kNumPatches * kPatchBytes);
  for (auto _ : state) {
    benchmark::DoNotOptimize(networks.DescribePatches(std::span(patches)).data());
  }
}
#define LIFT_SLAM_DESCRIBE(topology, precision)                                         \
  BENCHMARK_CAPTURE(BM_Describe1000, topology##_##precision, LiftTopology::k##topology, \
                    nn::Precision::k##precision)                                        \
      ->Arg(1)                                                                          \
      ->Arg(2)                                                                          \
      ->Unit(benchmark::kMillisecond)                                                   \
      ->UseRealTime()
LIFT_SLAM_DESCRIBE(F, Float32);
LIFT_SLAM_DESCRIBE(F, Bfloat16);
LIFT_SLAM_DESCRIBE(F, Int8);
LIFT_SLAM_DESCRIBE(T, Float32);
LIFT_SLAM_DESCRIBE(T, Bfloat16);
LIFT_SLAM_DESCRIBE(T, Int8);

void BM_Orient1000(benchmark::State& state, nn::Precision precision) {
  LiftNetworks networks(RandomLiftWeights(LiftTopology::kF, 1),
                        {.precision = precision, .num_threads = static_cast<int>(state.range(0))});
  const auto patches = RandomPixels(kNumPatches * kPatchBytes);
  for (auto _ : state) benchmark::DoNotOptimize(networks.OrientPatches(patches).data());
}
BENCHMARK_CAPTURE(BM_Orient1000, Float32, nn::Precision::kFloat32)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(BM_Orient1000, Bfloat16, nn::Precision::kBfloat16)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_DetectorKittiSize(benchmark::State& state, DetectorMethod method) {
  LiftNetworks networks(RandomLiftWeights(LiftTopology::kF, 1, /*with_orientation=*/false),
                        {.detector = method, .num_threads = static_cast<int>(state.range(0))});
  const GrayImage image = RandomImage(1241, 376);
  for (auto _ : state) benchmark::DoNotOptimize(networks.DetectorScores(image).scores.data());
}
BENCHMARK_CAPTURE(BM_DetectorKittiSize, Direct, DetectorMethod::kDirect)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(BM_DetectorKittiSize, Fourier, DetectorMethod::kFourier)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void BM_Sample1000Patches(benchmark::State& state) {
  const GrayImage image = RandomImage(1241, 376);
  std::vector<std::uint8_t> patch(kPatchBytes);
  Random random(2);
  for (auto _ : state) {
    for (int i = 0; i < kNumPatches; ++i) {
      SamplePatch(image,
                  {.x = random.Uniform(30, 1200),
                   .y = random.Uniform(30, 340),
                   .half_width_px = 20.0,
                   .angle_rad = random.Uniform(-3, 3)},
                  kLiftPatchSize, std::span(patch));
      benchmark::DoNotOptimize(patch.data());
    }
  }
}
BENCHMARK(BM_Sample1000Patches)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lift_slam
