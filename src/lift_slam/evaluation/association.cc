#include "lift_slam/evaluation/association.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>

#include "lift_slam/evaluation/error_statistics.h"
#include "lift_slam/geometry/timestamp_text.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr double kUnitMixUpRatio = 1e6;

// A kOk pose with its shifted stamp and its place in the trajectory.
struct StampedPose {
  std::int64_t timestamp_ns = 0;
  std::size_t index = 0;
  Rigid3d world_from_cam;
};
using StampedPoses = std::vector<StampedPose>;

std::int64_t ToNanoseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(seconds * 1e9));
}

StampedPoses OkPoses(const Trajectory& trajectory, std::int64_t offset_ns) {
  StampedPoses poses;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (trajectory[i].state != PoseState::kOk) continue;
    poses.push_back({trajectory[i].timestamp_ns + offset_ns, i, trajectory[i].world_from_cam});
  }
  return poses;
}

bool StampBefore(const StampedPose& pose, std::int64_t stamp) { return pose.timestamp_ns < stamp; }

bool KnowsFrameIndices(const Trajectory& trajectory) {
  return std::all_of(trajectory.begin(), trajectory.end(),
                     [](const TrajectoryPose& pose) { return pose.frame_index >= 0; });
}

[[noreturn]] void FailWithoutPairs(const StampedPoses& estimate, const StampedPoses& reference,
                                   double max_difference_ms) {
  const auto magnitude = [](const StampedPoses& poses) {
    return std::max({std::abs(static_cast<double>(poses.front().timestamp_ns)),
                     std::abs(static_cast<double>(poses.back().timestamp_ns)), 1.0});
  };
  const double ratio = magnitude(estimate) / magnitude(reference);
  const bool mix_up = ratio > kUnitMixUpRatio || ratio < 1.0 / kUnitMixUpRatio;
  throw InputError(fmt::format(
      "no estimated pose is within {} ms of a reference pose: the estimate covers {} to {} s, the "
      "reference {} to {} s{}",
      max_difference_ms, FormatSeconds(estimate.front().timestamp_ns),
      FormatSeconds(estimate.back().timestamp_ns), FormatSeconds(reference.front().timestamp_ns),
      FormatSeconds(reference.back().timestamp_ns),
      mix_up ? "; one of them is probably in the wrong unit (seconds against nanoseconds)" : ""));
}

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;  // estimate, reference

// Greedy one-to-one nearest neighbours (section "Association" of docs/evaluation.md).
IndexPairs MatchByTime(const StampedPoses& estimate, const StampedPoses& reference,
                       std::int64_t max_difference_ns) {
  std::vector<std::tuple<std::int64_t, std::size_t, std::size_t>> candidates;
  for (std::size_t e = 0; e < estimate.size(); ++e) {
    const std::int64_t stamp = estimate[e].timestamp_ns;
    const auto first = std::lower_bound(reference.begin(), reference.end(),
                                        stamp - max_difference_ns, StampBefore);
    for (auto it = first; it != reference.end() && it->timestamp_ns - stamp <= max_difference_ns;
         ++it) {
      candidates.emplace_back(std::abs(it->timestamp_ns - stamp), e,
                              static_cast<std::size_t>(it - reference.begin()));
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<char> estimate_taken(estimate.size(), 0), reference_taken(reference.size(), 0);
  IndexPairs pairs;
  for (const auto& [difference, e, r] : candidates) {
    if (estimate_taken[e] != 0 || reference_taken[r] != 0) continue;
    estimate_taken[e] = reference_taken[r] = 1;
    pairs.emplace_back(e, r);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void SetTimeDifferences(std::vector<double> differences_s, Association& association) {
  if (differences_s.empty()) return;
  association.max_time_difference_s = *std::max_element(differences_s.begin(), differences_s.end());
  association.median_time_difference_s = Median(std::move(differences_s));
}

double DifferenceSeconds(std::int64_t a_ns, std::int64_t b_ns) {
  return static_cast<double>(std::abs(a_ns - b_ns)) * 1e-9;
}

Association AssociateByTime(const StampedPoses& estimate, const StampedPoses& reference,
                            std::int64_t max_difference_ns) {
  Association association;
  std::vector<double> differences_s;
  for (const auto& [e, r] : MatchByTime(estimate, reference, max_difference_ns)) {
    association.pairs.push_back({estimate[e].index, reference[r].index, estimate[e].world_from_cam,
                                 reference[r].world_from_cam});
    differences_s.push_back(DifferenceSeconds(estimate[e].timestamp_ns, reference[r].timestamp_ns));
  }
  SetTimeDifferences(std::move(differences_s), association);
  return association;
}

struct Interpolated {
  Rigid3d world_from_cam;
  const StampedPose* nearest = nullptr;
};

// The pose at `stamp` between two neighbours that are both within the limit; no extrapolation.
std::optional<Interpolated> Interpolate(const StampedPoses& poses, std::int64_t stamp,
                                        std::int64_t limit_ns) {
  const auto after = std::lower_bound(poses.begin(), poses.end(), stamp, StampBefore);
  if (after == poses.end()) return std::nullopt;
  if (after->timestamp_ns == stamp) return Interpolated{after->world_from_cam, &*after};
  if (after == poses.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const std::int64_t to_before = stamp - before->timestamp_ns;
  const std::int64_t to_after = after->timestamp_ns - stamp;
  if (to_before > limit_ns || to_after > limit_ns) return std::nullopt;
  const double weight = static_cast<double>(to_before) / static_cast<double>(to_before + to_after);
  const Rigid3d& a = before->world_from_cam;
  const Rigid3d& b = after->world_from_cam;
  return Interpolated{
      Rigid3d(a.rotation.slerp(weight, b.rotation),
              Eigen::Vector3d((1.0 - weight) * a.translation + weight * b.translation)),
      to_before <= to_after ? &*before : &*after};
}

double Rate(const StampedPoses& poses) {
  if (poses.size() < 2) return 0.0;
  const auto span = static_cast<double>(poses.back().timestamp_ns - poses.front().timestamp_ns);
  return static_cast<double>(poses.size() - 1) / span;
}

Association AssociateInterpolated(const StampedPoses& estimate, const StampedPoses& reference,
                                  std::int64_t max_difference_ns) {
  const bool reference_is_denser = Rate(reference) >= Rate(estimate);
  const StampedPoses& dense = reference_is_denser ? reference : estimate;
  Association association;
  std::vector<double> differences_s;
  for (const StampedPose& pose : reference_is_denser ? estimate : reference) {
    const auto other = Interpolate(dense, pose.timestamp_ns, 2 * max_difference_ns);
    if (!other) continue;
    const PosePair pair = reference_is_denser
                              ? PosePair{pose.index, other->nearest->index, pose.world_from_cam,
                                         other->world_from_cam}
                              : PosePair{other->nearest->index, pose.index, other->world_from_cam,
                                         pose.world_from_cam};
    association.pairs.push_back(pair);
    differences_s.push_back(DifferenceSeconds(pose.timestamp_ns, other->nearest->timestamp_ns));
  }
  SetTimeDifferences(std::move(differences_s), association);
  return association;
}

Association AssociateByIndex(const Trajectory& estimate, const Trajectory& reference) {
  if (!KnowsFrameIndices(estimate) || !KnowsFrameIndices(reference)) {
    throw InputError("pairing by index needs a frame index for each pose (KITTI formats)");
  }
  std::vector<std::pair<std::int64_t, std::size_t>> reference_by_frame;
  for (std::size_t r = 0; r < reference.size(); ++r) {
    if (reference[r].state == PoseState::kOk) {
      reference_by_frame.emplace_back(reference[r].frame_index, r);
    }
  }
  std::sort(reference_by_frame.begin(), reference_by_frame.end());
  Association association;
  for (std::size_t e = 0; e < estimate.size(); ++e) {
    if (estimate[e].state != PoseState::kOk) continue;
    const std::pair<std::int64_t, std::size_t> wanted(estimate[e].frame_index, 0);
    const auto it = std::lower_bound(reference_by_frame.begin(), reference_by_frame.end(), wanted);
    if (it == reference_by_frame.end() || it->first != wanted.first) continue;
    association.pairs.push_back(
        {e, it->second, estimate[e].world_from_cam, reference[it->second].world_from_cam});
  }
  return association;
}

}  // namespace

AssociationMethod ResolveMethod(const Trajectory& estimate, const Trajectory& reference,
                                AssociationMethod method) {
  if (method != AssociationMethod::kAuto) return method;
  return KnowsFrameIndices(estimate) && KnowsFrameIndices(reference) ? AssociationMethod::kIndex
                                                                     : AssociationMethod::kTime;
}

Association Associate(const Trajectory& estimate, const Trajectory& reference,
                      const AssociationOptions& options) {
  const StampedPoses estimate_poses = OkPoses(estimate, ToNanoseconds(options.offset_s));
  const StampedPoses reference_poses = OkPoses(reference, 0);
  if (reference_poses.empty()) throw InputError("the reference trajectory holds no pose");
  const AssociationMethod method = ResolveMethod(estimate, reference, options.method);
  const std::int64_t max_difference_ns = ToNanoseconds(options.max_time_difference_ms * 1e-3);
  Association association;
  if (method == AssociationMethod::kIndex) {
    association = AssociateByIndex(estimate, reference);
  } else if (options.interpolate) {
    association = AssociateInterpolated(estimate_poses, reference_poses, max_difference_ns);
  } else {
    association = AssociateByTime(estimate_poses, reference_poses, max_difference_ns);
  }
  association.method = method;
  const std::size_t num_pairs = association.pairs.size();
  association.num_unpaired_estimate =
      estimate_poses.size() - std::min(num_pairs, estimate_poses.size());
  association.num_unpaired_reference =
      reference_poses.size() - std::min(num_pairs, reference_poses.size());
  if (!association.pairs.empty() || estimate_poses.empty()) return association;
  if (method == AssociationMethod::kTime) {
    FailWithoutPairs(estimate_poses, reference_poses, options.max_time_difference_ms);
  }
  throw InputError(fmt::format(
      "no frame index is in both trajectories: the estimate holds frames {} to {}, the reference "
      "{} to {}",
      estimate[estimate_poses.front().index].frame_index,
      estimate[estimate_poses.back().index].frame_index,
      reference[reference_poses.front().index].frame_index,
      reference[reference_poses.back().index].frame_index));
}

}  // namespace lift_slam
