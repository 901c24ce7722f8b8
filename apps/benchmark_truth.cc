#include "apps/benchmark_truth.h"

#include <algorithm>

#include "apps/sequence_arguments.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

std::unique_ptr<Sequence> Open(const BenchmarkJob& job) {
  try {
    SequenceArguments arguments;
    arguments.frames = job.frames;
    SequenceOptions options = arguments.Options();
    options.calibration = CalibrationNeed::kOptional;
    return OpenSequence(job.source.string(), options);
  } catch (const InputError&) {
    return nullptr;
  }
}

bool IsKittiFormat(SequenceFormat format) {
  return format == SequenceFormat::kKittiOdometry || format == SequenceFormat::kKittiRaw;
}

// Poses of frames before the first and after the last that is run belong to other parts.
void CutByIndex(const std::vector<FrameStamp>& frames, Trajectory& poses) {
  if (frames.empty()) return;
  const auto [first, last] = std::ranges::minmax(frames, {}, &FrameStamp::frame_index);
  std::erase_if(poses, [&](const TrajectoryPose& pose) {
    return pose.frame_index < first.frame_index || pose.frame_index > last.frame_index;
  });
}

}  // namespace

std::optional<BenchmarkTruth> LoadBenchmarkTruth(const BenchmarkJob& job) {
  const auto sequence = Open(job);
  if (!sequence) return std::nullopt;
  BenchmarkTruth truth;
  truth.sequence = sequence->info();
  truth.view = IsKittiFormat(truth.sequence.format) ? TopView::kXZ : TopView::kXY;
  if (!truth.sequence.ground_truth) return truth;
  truth.poses = truth.sequence.ground_truth->poses;
  truth.by_index = truth.sequence.ground_truth->by_index;
  if (truth.by_index) CutByIndex(truth.sequence.frames, truth.poses);
  return truth;
}

}  // namespace lift_slam
