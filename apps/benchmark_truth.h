#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "apps/benchmark_plan.h"
#include "lift_slam/evaluation/evaluation_options.h"
#include "lift_slam/geometry/trajectory.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// Ground truth of a benchmark's sequence, cut to the part that is run.
struct BenchmarkTruth {
  Trajectory poses;  // of the camera; empty: there is none
  TopView view = TopView::kXY;
  EvaluationOptions evaluation;  // how a trajectory is paired with it
  std::int64_t num_frames = 0;
  // Times of the frames by index where the truth has none of its own (KITTI); else empty.
  std::vector<std::int64_t> frame_times_ns;
};

// Of the sequence of a job. Nothing when the data is not there any more.
std::optional<BenchmarkTruth> LoadBenchmarkTruth(const BenchmarkJob& job);

}  // namespace lift_slam
