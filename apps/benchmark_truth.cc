#include "apps/benchmark_truth.h"

#include <algorithm>

#include "apps/sequence_arguments.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

std::unique_ptr<Sequence> Open(const BenchmarkJob& job, SequenceOptions& options) {
  try {
    SequenceArguments arguments;
    arguments.frames = job.frames;
    options = arguments.Options();
    options.calibration = CalibrationNeed::kOptional;
    return OpenSequence(job.source.string(), options);
  } catch (const InputError&) {
    return nullptr;
  }
}

bool IsKittiFormat(SequenceFormat format) {
  return format == SequenceFormat::kKittiOdometry || format == SequenceFormat::kKittiRaw;
}

// Poses of frames after the last that is run belong to another part of the sequence.
void CutByIndex(const SequenceOptions& options, BenchmarkTruth& truth) {
  const std::int64_t end = options.first + truth.num_frames * options.step;
  std::erase_if(truth.poses, [&](const TrajectoryPose& pose) {
    return pose.frame_index < options.first || pose.frame_index >= end;
  });
}

}  // namespace

std::optional<BenchmarkTruth> LoadBenchmarkTruth(const BenchmarkJob& job) {
  SequenceOptions options;
  const auto sequence = Open(job, options);
  if (!sequence) return std::nullopt;
  const SequenceInfo& info = sequence->info();
  BenchmarkTruth truth;
  truth.num_frames = info.num_frames.value_or(0);
  truth.view = IsKittiFormat(info.format) ? TopView::kXZ : TopView::kXY;
  if (!info.ground_truth) return truth;
  truth.poses = info.ground_truth->poses;
  AssociationOptions& association = truth.evaluation.association;
  association.method =
      info.ground_truth->by_index ? AssociationMethod::kIndex : AssociationMethod::kTime;
  if (info.format == SequenceFormat::kEuroc) {
    association.max_time_difference_ms = kEurocMaxTimeDifferenceMs;
  }
  if (!info.ground_truth->by_index) return truth;
  CutByIndex(options, truth);
  const std::filesystem::path times = job.source / "times.txt";
  if (std::filesystem::is_regular_file(times)) truth.frame_times_ns = ReadTimestamps(times);
  return truth;
}

}  // namespace lift_slam
