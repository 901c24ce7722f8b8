// Whole stages on a map of known truth: tracking of one frame (without extraction), and mapping of
// one keyframe (new points, fusion, local bundle adjustment, culling).
#include <benchmark/benchmark.h>

#include <ctime>

#include "benchmarks/runtime/synthetic_map.h"
#include "lift_slam/local_mapping/local_mapper.h"
#include "lift_slam/tracking/tracker.h"

namespace lift_slam {
namespace {

constexpr SyntheticMapOptions kOptions;

// CPU time of this thread: both stages run in one, and what else the machine does counts little.
double ThreadSeconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void BM_TrackFrame(benchmark::State& state) {
  const SyntheticMap synthetic(kOptions);
  const auto map = synthetic.MakeMap();
  const Frame last = synthetic.MakeTrackedFrame(kOptions.num_keyframes - 1);
  const Frame next = synthetic.MakeFrame(kOptions.num_keyframes);
  Tracker started({}, MatchingOptions(), /*seed=*/0);
  started.Start(*map, last, next.cam_from_world * Inverse(last.cam_from_world));
  TrackingResult result;
  for (auto _ : state) {
    Tracker tracker = started;
    Frame frame = next;
    const double start_s = ThreadSeconds();
    result = tracker.Track(*map, frame);
    state.SetIterationTime(ThreadSeconds() - start_s);
  }
  state.counters["inliers"] = result.num_inliers;
}
BENCHMARK(BM_TrackFrame)->Unit(benchmark::kMillisecond)->UseManualTime();

void BM_MapKeyFrame(benchmark::State& state) {
  const SyntheticMap synthetic(kOptions);
  const Frame next = synthetic.MakeTrackedFrame(kOptions.num_keyframes);
  MappingReport report;
  for (auto _ : state) {
    const auto map = synthetic.MakeMap();
    LocalMapper mapper({}, {});
    const double start_s = ThreadSeconds();
    report = mapper.Process(map->AddKeyFrame(next), 50.0F, *map);
    state.SetIterationTime(ThreadSeconds() - start_s);
  }
  state.counters["points_created"] = report.points_created;
  state.counters["create_ms"] = report.create_ms;
  state.counters["fuse_ms"] = report.fuse_ms;
  state.counters["bundle_ms"] = report.bundle_ms;
  state.counters["cull_ms"] = report.cull_ms;
}
BENCHMARK(BM_MapKeyFrame)->Unit(benchmark::kMillisecond)->UseManualTime()->MinTime(1.0);

}  // namespace
}  // namespace lift_slam
