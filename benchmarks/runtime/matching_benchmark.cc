// Matching in a map of known truth: 15 keyframes, about 2000 features a view, 1980 map points.
#include <benchmark/benchmark.h>

#include "benchmarks/runtime/synthetic_map.h"
#include "lift_slam/matching/epipolar_matcher.h"
#include "lift_slam/matching/frame_matcher.h"

namespace lift_slam {
namespace {

constexpr int kNext = 15;  // the camera after the last keyframe

void BM_MatchLocalPoints(benchmark::State& state) {
  const SyntheticMap synthetic({});
  const auto map = synthetic.MakeMap();
  const std::vector<MapPointId> points = map->PointIds();
  const Frame frame = synthetic.MakeFrame(kNext);
  int matches = 0;
  for (auto _ : state) {
    Frame matched = frame;
    matches = MatchLocalPoints(*map, points, 1.0F, 100.0F, matched).num_matches;
  }
  state.counters["features"] = frame.features->size();
  state.counters["points"] = static_cast<double>(points.size());
  state.counters["matches"] = matches;
}
BENCHMARK(BM_MatchLocalPoints)->Unit(benchmark::kMillisecond);

void BM_MatchFromLastFrame(benchmark::State& state) {
  const SyntheticMap synthetic({});
  const auto map = synthetic.MakeMap();
  const Frame last = synthetic.MakeTrackedFrame(kNext - 1);
  const Frame frame = synthetic.MakeFrame(kNext);
  int matches = 0;
  for (auto _ : state) {
    Frame matched = frame;
    matches = MatchFromLastFrame(*map, last, 15.0F, 100.0F, matched);
  }
  state.counters["matches"] = matches;
}
BENCHMARK(BM_MatchFromLastFrame)->Unit(benchmark::kMillisecond);

// Without prediction: every feature against every feature with a map point.
void BM_MatchFromKeyFrame(benchmark::State& state) {
  const SyntheticMap synthetic({});
  const auto map = synthetic.MakeMap();
  const KeyFrame& keyframe = map->keyframe(map->newest_keyframe());
  const Frame frame = synthetic.MakeFrame(kNext);
  int matches = 0;
  for (auto _ : state) {
    Frame matched = frame;
    matches = MatchFromKeyFrame(*map, keyframe, 50.0F, matched);
  }
  state.counters["matches"] = matches;
}
BENCHMARK(BM_MatchFromKeyFrame)->Unit(benchmark::kMillisecond);

// The features without map points of two neighbouring keyframes: 40 % of them.
void BM_MatchAlongEpipolarLines(benchmark::State& state) {
  const SyntheticMap synthetic({});
  const auto map = synthetic.MakeMap();
  const KeyFrame& a = map->keyframe(map->newest_keyframe());
  const KeyFrame& b = map->keyframe(KeyFrameId(map->newest_keyframe().value - 3));
  std::size_t matches = 0;
  for (auto _ : state) {
    matches = MatchAlongEpipolarLines(a, b, /*min_depth=*/1.0, 50.0F, *synthetic.view(), {}).size();
  }
  state.counters["matches"] = static_cast<double>(matches);
}
BENCHMARK(BM_MatchAlongEpipolarLines)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lift_slam
