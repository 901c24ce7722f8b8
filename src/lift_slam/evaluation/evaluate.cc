#include "lift_slam/evaluation/evaluate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "lift_slam/evaluation/pose_errors.h"
#include "lift_slam/geometry/sim3.h"
#include "lift_slam/geometry/timestamp_text.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

void CheckFinite(const Trajectory& trajectory, std::string_view name) {
  for (const TrajectoryPose& pose : trajectory) {
    if (pose.state != PoseState::kOk) continue;
    if (pose.world_from_cam.translation.allFinite() &&
        pose.world_from_cam.rotation.coeffs().allFinite()) {
      continue;
    }
    throw InputError(
        fmt::format("the {} pose at {} s is not finite", name, FormatSeconds(pose.timestamp_ns)));
  }
}

Alignment AlignPairs(const std::vector<PosePair>& pairs, const EvaluationOptions& options) {
  std::size_t count = pairs.size();
  if (options.align_first > 0) {
    count = std::min(count, static_cast<std::size_t>(options.align_first));
  }
  std::vector<Rigid3d> estimate, reference;
  for (std::size_t i = 0; i < count; ++i) {
    estimate.push_back(pairs[i].estimate);
    reference.push_back(pairs[i].reference);
  }
  return AlignPoses(estimate, reference, options.alignment);
}

std::vector<PosePair> AlignedPairs(std::vector<PosePair> pairs,
                                   const Sim3d& reference_from_estimate) {
  for (PosePair& pair : pairs) {
    pair.estimate = TransformWorld(pair.estimate, reference_from_estimate);
  }
  return pairs;
}

Trajectory AlignedTrajectory(Trajectory trajectory, const Sim3d& reference_from_estimate) {
  for (TrajectoryPose& pose : trajectory) {
    if (pose.state != PoseState::kOk) continue;
    pose.world_from_cam = TransformWorld(pose.world_from_cam, reference_from_estimate);
  }
  return trajectory;
}

// The number of each entry's frame in the sequence: known, or, where there are times alone, as
// their gaps say.
std::vector<std::int64_t> FrameOfEntry(const Trajectory& estimate, const EvaluationResult& result) {
  const bool lists_every_frame = result.options.estimate_lists_every_frame;
  const bool by_index = result.association.method == AssociationMethod::kIndex;
  std::vector<std::int64_t> frames(estimate.size(), -1), stamps_ns;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    frames[i] = lists_every_frame ? static_cast<std::int64_t>(i) : estimate[i].frame_index;
    if (estimate[i].state == PoseState::kOk) stamps_ns.push_back(estimate[i].timestamp_ns);
  }
  if (lists_every_frame || by_index) return frames;
  const std::vector<std::int64_t> numbers = FrameNumbers(stamps_ns);
  auto number = numbers.begin();
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    if (estimate[i].state == PoseState::kOk) frames[i] = *number++;
  }
  return frames;
}

std::vector<std::int64_t> FrameOfPair(const Trajectory& estimate, const EvaluationResult& result) {
  const std::vector<std::int64_t> frame_of_entry = FrameOfEntry(estimate, result);
  std::vector<std::int64_t> frames;
  for (const PosePair& pair : result.association.pairs) {
    frames.push_back(frame_of_entry[pair.estimate_index]);
  }
  return frames;
}

void MeasureErrors(const Trajectory& estimate, const Trajectory& reference,
                   EvaluationResult& result) {
  const std::vector<PosePair> aligned =
      AlignedPairs(result.association.pairs, *result.reference_from_estimate);
  const std::vector<double> position_errors_m = PositionErrorsM(aligned);
  const std::vector<double> rotation_errors_deg = RotationErrorsDeg(aligned);
  result.ate_m = Summarize(position_errors_m);
  result.ate_rotation_deg = Summarize(rotation_errors_deg);
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    const TrajectoryPose& pose = estimate[aligned[i].estimate_index];
    result.frame_errors.push_back(
        {pose.frame_index, pose.timestamp_ns, position_errors_m[i], rotation_errors_deg[i]});
  }
  if (result.association.method == AssociationMethod::kIndex) {
    result.kitti = ComputeKittiError(reference, aligned);
  }
  result.rpe = ComputeRelativePoseError(aligned, FrameOfPair(estimate, result), result.options.rpe);
  result.scale_drift = ComputeScaleDrift(aligned);
  result.aligned_estimate = AlignedTrajectory(estimate, *result.reference_from_estimate);
}

}  // namespace

std::string_view Name(TrajectoryKind kind) {
  switch (kind) {
    case TrajectoryKind::kFinal:
      return "final";
    case TrajectoryKind::kOnline:
      return "online";
    case TrajectoryKind::kKeyframes:
      return "keyframes";
  }
  return "unknown";
}

EvaluationResult Evaluate(const Trajectory& estimate, const Trajectory& reference,
                          const EvaluationOptions& options) {
  options.Check();
  CheckFinite(estimate, "estimated");
  CheckFinite(reference, "reference");
  EvaluationResult result;
  result.options = options;
  const bool has_reference = !reference.empty();
  if (has_reference) {
    result.association = Associate(estimate, reference, options.association);
  } else if (!options.estimate_lists_every_frame) {
    throw InputError("the reference trajectory holds no pose");
  }
  result.coverage =
      ComputeCoverage(ListFrames(estimate, reference, result.association.method, options),
                      reference, options.frames_total);
  result.status = JudgeRun(result.coverage, options.status);
  if (!has_reference) {
    result.no_errors_reason = "There is no reference trajectory.";
    return result;
  }
  if (result.association.pairs.empty()) {
    result.no_errors_reason = "The estimate holds no pose.";
    return result;
  }
  const Alignment alignment = AlignPairs(result.association.pairs, options);
  result.reference_from_estimate = alignment.reference_from_estimate;
  if (!alignment.reference_from_estimate) {
    result.no_errors_reason = Explain(alignment.failure);
    return result;
  }
  result.num_alignment_pairs =
      options.align_first > 0
          ? std::min(result.association.pairs.size(), static_cast<std::size_t>(options.align_first))
          : result.association.pairs.size();
  MeasureErrors(estimate, reference, result);
  return result;
}

std::vector<MapEvaluation> EvaluateEachMap(const Trajectory& estimate,
                                           const std::vector<int>& map_of_entry,
                                           const Trajectory& reference,
                                           const EvaluationOptions& options) {
  LIFT_SLAM_CHECK(estimate.size() == map_of_entry.size(), "{} poses, {} map indices",
                  estimate.size(), map_of_entry.size());
  const Association association = Associate(estimate, reference, options.association);
  std::set<int> maps(map_of_entry.begin(), map_of_entry.end());
  maps.erase(-1);
  std::vector<MapEvaluation> evaluations;
  for (const int map : maps) {
    std::vector<PosePair> pairs;
    for (const PosePair& pair : association.pairs) {
      if (map_of_entry[pair.estimate_index] == map) pairs.push_back(pair);
    }
    MapEvaluation& evaluation = evaluations.emplace_back();
    evaluation.map_index = map;
    evaluation.num_poses = pairs.size();
    const Alignment alignment = AlignPairs(pairs, options);
    if (!alignment.reference_from_estimate) continue;
    evaluation.ate_m = Summarize(
        PositionErrorsM(AlignedPairs(std::move(pairs), *alignment.reference_from_estimate)));
  }
  return evaluations;
}

}  // namespace lift_slam
