#pragma once

#include <optional>

#include "apps/benchmark_plan.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/trajectory.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// A benchmark's sequence with its ground truth.
struct BenchmarkTruth {
  SequenceInfo sequence;  // of the part that is run; its ground truth is whole
  // Of the camera; empty: there is none. Poses by index are those of the part that is run.
  Trajectory poses;
  TopView view = TopView::kXY;
  bool by_index = false;
};

// Of the sequence of a job. Nothing when the data is not there any more.
std::optional<BenchmarkTruth> LoadBenchmarkTruth(const BenchmarkJob& job);

}  // namespace lift_slam
