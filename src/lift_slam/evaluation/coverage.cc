#include "lift_slam/evaluation/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>

#include "lift_slam/evaluation/error_statistics.h"
#include "lift_slam/evaluation/kitti_error.h"
#include "lift_slam/geometry/timestamp_text.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::int64_t kSameFrameToleranceNs = 500'000;
constexpr double kRoundingShare = 0.01;                 // of a frame interval
constexpr std::int64_t kMaxMissingFrames = 10'000'000;  // 90 hours at 30 Hz

bool StampBefore(const TrajectoryPose& pose, std::int64_t stamp) {
  return pose.timestamp_ns < stamp;
}

// The reference pose nearest in time, when within the limit. `reference` is sorted by time.
std::optional<std::size_t> NearestInTime(const Trajectory& reference, std::int64_t stamp,
                                         std::int64_t limit_ns) {
  const auto after = std::lower_bound(reference.begin(), reference.end(), stamp, StampBefore);
  std::optional<std::size_t> nearest;
  std::int64_t best = limit_ns;
  for (auto it = after == reference.begin() ? after : std::prev(after);
       it != reference.end() && it <= after; ++it) {
    const std::int64_t difference = std::abs(it->timestamp_ns - stamp);
    if (difference > best || (nearest && difference == best)) continue;
    best = difference;
    nearest = static_cast<std::size_t>(it - reference.begin());
  }
  return nearest;
}

FrameList FramesOfReference(const Trajectory& estimate, const Trajectory& reference) {
  std::vector<std::int64_t> ok_indices;
  for (const TrajectoryPose& pose : estimate) {
    if (pose.state == PoseState::kOk) ok_indices.push_back(pose.frame_index);
  }
  std::sort(ok_indices.begin(), ok_indices.end());
  FrameList list{FrameListSource::kReference, {}};
  for (std::size_t i = 0; i < reference.size(); ++i) {
    const bool ok =
        std::binary_search(ok_indices.begin(), ok_indices.end(), reference[i].frame_index);
    list.frames.push_back({reference[i].timestamp_ns, i, ok});
  }
  return list;
}

// How many whole frame intervals lie in a span, but for rounding.
std::int64_t WholeIntervals(std::int64_t span_ns, double interval_ns) {
  if (interval_ns <= 0.0) return 0;
  return std::max<std::int64_t>(
      0, static_cast<std::int64_t>(
             std::floor(static_cast<double>(span_ns) / interval_ns + kRoundingShare)));
}

double MedianIntervalNs(const std::vector<std::int64_t>& stamps) {
  std::vector<double> intervals;
  for (std::size_t i = 1; i < stamps.size(); ++i) {
    intervals.push_back(static_cast<double>(stamps[i] - stamps[i - 1]));
  }
  return intervals.empty() ? 0.0 : Median(std::move(intervals));
}

// Frames without pose between two stamps, both excluded.
void AppendMissing(std::int64_t from_ns, std::int64_t count, double interval_ns,
                   std::vector<FrameStatus>& frames) {
  if (count > kMaxMissingFrames) {
    throw InputError(fmt::format(
        "{} s without a pose after {} s are {} frames at the trajectory's median rate: a wrong "
        "timestamp? If not, give the times of all frames (--times)",
        FormatSeconds(std::llround(static_cast<double>(count) * interval_ns)),
        FormatSeconds(from_ns), count));
  }
  for (std::int64_t k = 1; k <= count; ++k) {
    const auto stamp = from_ns + std::llround(static_cast<double>(k) * interval_ns);
    frames.push_back({stamp, std::nullopt, false});
  }
}

// As the median interval of the poses says. `frames_total`: of the whole input; 0: not known.
FrameList InferredFrames(const Trajectory& estimate, const Trajectory& reference,
                         std::int64_t offset_ns, int frames_total) {
  std::vector<std::int64_t> stamps;
  for (const TrajectoryPose& pose : estimate) {
    if (pose.state == PoseState::kOk) stamps.push_back(pose.timestamp_ns + offset_ns);
  }
  FrameList list{FrameListSource::kInferred, {}};
  if (stamps.empty()) {  // no rate is known: the reference's own poses stand for the frames
    for (const TrajectoryPose& pose : reference) {
      list.frames.push_back({pose.timestamp_ns, std::nullopt, false});
    }
    return list;
  }
  const double interval_ns = MedianIntervalNs(stamps);
  const std::vector<std::int64_t> numbers = FrameNumbers(stamps);
  // What the reference covers before the first and after the last pose, as far as there are so many
  // frames.
  std::int64_t room = frames_total > 0
                          ? std::max<std::int64_t>(0, frames_total - (numbers.back() + 1))
                          : std::numeric_limits<std::int64_t>::max();
  const std::int64_t before =
      std::min(room, WholeIntervals(stamps.front() - reference.front().timestamp_ns, interval_ns));
  room -= before;
  const std::int64_t after =
      std::min(room, WholeIntervals(reference.back().timestamp_ns - stamps.back(), interval_ns));
  const auto start = stamps.front() - std::llround(static_cast<double>(before + 1) * interval_ns);
  AppendMissing(start, before, interval_ns, list.frames);
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (i > 0) {
      AppendMissing(stamps[i - 1], numbers[i] - numbers[i - 1] - 1, interval_ns, list.frames);
    }
    list.frames.push_back({stamps[i], std::nullopt, true});
  }
  AppendMissing(stamps.back(), after, interval_ns, list.frames);
  return list;
}

FrameList FramesOfEstimate(const Trajectory& estimate, std::int64_t offset_ns) {
  FrameList list{FrameListSource::kEstimate, {}};
  for (const TrajectoryPose& pose : estimate) {
    list.frames.push_back(
        {pose.timestamp_ns + offset_ns, std::nullopt, pose.state == PoseState::kOk});
  }
  return list;
}

void LocateByTime(const Trajectory& reference, double max_difference_ms, FrameList& list) {
  const auto limit_ns = static_cast<std::int64_t>(std::llround(max_difference_ms * 1e6));
  for (FrameStatus& frame : list.frames) {
    frame.reference_index = NearestInTime(reference, frame.timestamp_ns, limit_ns);
  }
}

void LocateByIndex(const Trajectory& estimate, const Trajectory& reference, FrameList& list) {
  const auto before = [](const TrajectoryPose& pose, std::int64_t index) {
    return pose.frame_index < index;
  };
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const std::int64_t wanted = estimate[i].frame_index;
    const auto it = std::lower_bound(reference.begin(), reference.end(), wanted, before);
    if (it == reference.end() || it->frame_index != wanted) continue;
    list.frames[i].reference_index = static_cast<std::size_t>(it - reference.begin());
  }
}

void CountRuns(const FrameList& list, Coverage& coverage) {
  int run = 0;
  for (std::size_t i = 0; i < list.frames.size(); ++i) {
    if (!list.frames[i].ok) {
      if (run > 0) ++coverage.lost_events;
      run = 0;
      continue;
    }
    if (!coverage.init_frame) coverage.init_frame = static_cast<int>(i);
    ++coverage.frames_ok;
    coverage.longest_ok_run = std::max(coverage.longest_ok_run, ++run);
    coverage.lost_at_end_s =
        static_cast<double>(list.frames.back().timestamp_ns - list.frames[i].timestamp_ns) * 1e-9;
  }
}

std::optional<double> PathCovered(const FrameList& list, const Trajectory& reference) {
  const std::vector<double> path_m = CumulativePathLength(reference);
  const FrameStatus* first = nullptr;
  const FrameStatus* previous = nullptr;  // the last frame that has a place in the reference
  bool gap = false;                       // a frame without a pose since then
  double covered_m = 0.0;
  for (const FrameStatus& frame : list.frames) {
    if (!frame.reference_index) {
      gap = gap || !frame.ok;
      continue;
    }
    if (first == nullptr) first = &frame;
    if (previous != nullptr && !gap && previous->ok && frame.ok) {
      covered_m += path_m[*frame.reference_index] - path_m[*previous->reference_index];
    }
    previous = &frame;
    gap = false;
  }
  if (previous == nullptr) return std::nullopt;
  const double total_m = path_m[*previous->reference_index] - path_m[*first->reference_index];
  if (!(total_m > 0.0)) return std::nullopt;
  return covered_m / total_m;
}

}  // namespace

std::string_view Name(FrameListSource source) {
  switch (source) {
    case FrameListSource::kEstimate:
      return "estimate";
    case FrameListSource::kReference:
      return "reference";
    case FrameListSource::kInferred:
      return "inferred";
  }
  return "unknown";
}

FrameList ListFrames(const Trajectory& estimate, const Trajectory& reference,
                     AssociationMethod method, const EvaluationOptions& options) {
  const bool by_index = method == AssociationMethod::kIndex;
  if (by_index && !options.estimate_lists_every_frame) {
    return FramesOfReference(estimate, reference);
  }
  const auto offset_ns =
      static_cast<std::int64_t>(std::llround(options.association.offset_s * 1e9));
  FrameList list = options.estimate_lists_every_frame
                       ? FramesOfEstimate(estimate, offset_ns)
                       : InferredFrames(estimate, reference, offset_ns, options.frames_total);
  if (by_index) {
    LocateByIndex(estimate, reference, list);
  } else {
    LocateByTime(reference, options.association.max_time_difference_ms, list);
  }
  return list;
}

std::vector<std::int64_t> FrameNumbers(const std::vector<std::int64_t>& stamps_ns) {
  const double interval_ns = MedianIntervalNs(stamps_ns);
  if (stamps_ns.empty()) return {};
  std::vector<std::int64_t> numbers = {0};
  for (std::size_t i = 1; i < stamps_ns.size(); ++i) {
    const auto gap = static_cast<double>(stamps_ns[i] - stamps_ns[i - 1]);
    const std::int64_t steps = interval_ns > 0.0 ? std::llround(gap / interval_ns) : 1;
    numbers.push_back(numbers.back() + std::max<std::int64_t>(1, steps));
  }
  return numbers;
}

Trajectory WithEveryFrame(const Trajectory& estimate,
                          const std::vector<std::int64_t>& frame_timestamps_ns) {
  Trajectory complete;
  auto pose = estimate.begin();
  for (std::size_t i = 0; i < frame_timestamps_ns.size(); ++i) {
    const std::int64_t stamp = frame_timestamps_ns[i];
    TrajectoryPose frame;
    frame.state = pose == estimate.begin() ? PoseState::kNotInitialized : PoseState::kLost;
    if (pose != estimate.end() && std::abs(pose->timestamp_ns - stamp) <= kSameFrameToleranceNs) {
      frame = *pose++;
    }
    frame.frame_index = static_cast<std::int64_t>(i);
    frame.timestamp_ns = stamp;
    complete.push_back(frame);
  }
  if (pose != estimate.end()) {
    throw InputError(fmt::format("the pose at {} s belongs to no frame of the times file",
                                 FormatSeconds(pose->timestamp_ns)));
  }
  return complete;
}

Coverage ComputeCoverage(const FrameList& list, const Trajectory& reference, int frames_total) {
  Coverage coverage;
  coverage.source = list.source;
  CountRuns(list, coverage);
  coverage.frames_total = frames_total > 0 ? frames_total : static_cast<int>(list.frames.size());
  if (coverage.frames_total < coverage.frames_ok) {
    throw InputError(fmt::format("frames_total is {}, but {} frames have a pose",
                                 coverage.frames_total, coverage.frames_ok));
  }
  if (coverage.frames_total > 0) {
    coverage.coverage = static_cast<double>(coverage.frames_ok) / coverage.frames_total;
  }
  if (!reference.empty()) coverage.path_covered = PathCovered(list, reference);
  return coverage;
}

std::string_view Name(RunStatus status) {
  switch (status) {
    case RunStatus::kOk:
      return "OK";
    case RunStatus::kPartial:
      return "PARTIAL";
    case RunStatus::kFailInit:
      return "FAIL_INIT";
    case RunStatus::kFailLost:
      return "FAIL_LOST";
  }
  return "unknown";
}

bool IsFailure(RunStatus status) {
  return status == RunStatus::kFailInit || status == RunStatus::kFailLost;
}

RunStatus JudgeRun(const Coverage& coverage, const StatusThresholds& thresholds) {
  if (coverage.frames_ok == 0) return RunStatus::kFailInit;
  if (coverage.coverage < thresholds.min_partial_coverage ||
      coverage.lost_at_end_s > thresholds.max_lost_at_end_s) {
    return RunStatus::kFailLost;
  }
  return coverage.coverage < thresholds.min_ok_coverage ? RunStatus::kPartial : RunStatus::kOk;
}

}  // namespace lift_slam
