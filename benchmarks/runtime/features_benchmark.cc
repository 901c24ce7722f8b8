// Feature extraction and brute-force matching. Reads KITTI 00 where the data folder has it, and
// draws an image of the same size otherwise.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>

#include "lift_slam/features/orb/corner_orientation.h"
#include "lift_slam/features/orb/orb_extractor.h"
#include "lift_slam/image/pyramid.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

cv::Mat DrawnImage(std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(376, 1241, CV_8UC1, cv::Scalar(90));
  for (int i = 0; i < 3000; ++i) {
    const cv::Rect rectangle(random.UniformInt(0, 1240), random.UniformInt(0, 375),
                             random.UniformInt(4, 60), random.UniformInt(4, 60));
    cv::rectangle(image, rectangle, cv::Scalar(random.UniformInt(0, 255)), cv::FILLED);
  }
  cv::GaussianBlur(image, image, {3, 3}, 0.8);
  return image;
}

GrayImage KittiFrame(int index) {
  const char* data = std::getenv("LIFT_SLAM_DATA");
  const std::string number = std::to_string(index);
  const auto path = std::filesystem::path(data != nullptr ? data : "../shared/data") /
                    "kitti/sequences/00/image_0" /
                    (std::string(6 - number.size(), '0') + number + ".png");
  const auto image = ReadGrayImage(path);
  return image ? *image : GrayImage(DrawnImage(static_cast<std::uint64_t>(index)));
}

void BM_ExtractOrb(benchmark::State& state) {
  OrbExtractor extractor({.num_threads = static_cast<int>(state.range(0))});
  const GrayImage images[] = {KittiFrame(0), KittiFrame(40), KittiFrame(80)};
  std::size_t i = 0;
  for (auto _ : state) {
    const FeatureSet features = extractor.Extract(images[i++ % 3]);
    state.counters["features"] = static_cast<double>(features.keypoints.size());
  }
}
BENCHMARK(BM_ExtractOrb)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();

void BM_BuildPyramid(benchmark::State& state) {
  const GrayImage image = KittiFrame(0);
  for (auto _ : state) benchmark::DoNotOptimize(BuildPyramid(image, {}));
}
BENCHMARK(BM_BuildPyramid)->Unit(benchmark::kMillisecond);

void BM_FastCorners(benchmark::State& state) {
  const ImagePyramid pyramid = BuildPyramid(KittiFrame(0), {});
  FastScoreMap map;
  std::vector<Corner> corners;
  for (auto _ : state) {
    for (const PyramidLevel& level : pyramid) {
      map.Compute(level.image, OrbDescriptor::kBorder);
      map.FindCorners(7, corners);
    }
  }
}
BENCHMARK(BM_FastCorners)->Unit(benchmark::kMillisecond);

void BM_Describe2000(benchmark::State& state) {
  const GrayImage image = KittiFrame(0);
  Random random(1);
  std::vector<OrientedCorner> corners;
  for (int i = 0; i < 2000; ++i) {
    const int x = random.UniformInt(20, image.width() - 21);
    const int y = random.UniformInt(20, image.height() - 21);
    corners.push_back({x, y, IntensityCentroidAngle(image, x, y)});
  }
  OrbDescriptor descriptor;
  std::vector<std::byte> rows(corners.size() * OrbDescriptor::kBytes);
  for (auto _ : state) descriptor.Describe(image, corners, rows.data());
}
BENCHMARK(BM_Describe2000)->Unit(benchmark::kMillisecond);

void BM_MatchBruteForce(benchmark::State& state) {
  OrbExtractor extractor({.max_features = 2000});
  const Descriptors a = extractor.Extract(KittiFrame(0)).descriptors;
  const Descriptors b = extractor.Extract(KittiFrame(1)).descriptors;
  for (auto _ : state) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      float best = std::numeric_limits<float>::max();
      for (std::size_t j = 0; j < b.size(); ++j) {
        best = std::min(best, DescriptorDistance(a.kind(), a.row(i), b.row(j)));
      }
      benchmark::DoNotOptimize(best);
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(a.size() * b.size()));
}
BENCHMARK(BM_MatchBruteForce)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lift_slam

// One OpenCV thread, so that the figures are those of one core.
int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
