#include "lift_slam/evaluation/relative_pose_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

IndexPairs PairsByFrames(std::span<const std::int64_t> frame_of_pair, const RpeOptions& options) {
  const auto delta = static_cast<std::int64_t>(std::llround(options.delta));
  IndexPairs pairs;
  std::size_t i = 0;
  while (i < frame_of_pair.size()) {
    const auto it =
        std::lower_bound(frame_of_pair.begin(), frame_of_pair.end(), frame_of_pair[i] + delta);
    const auto j = static_cast<std::size_t>(it - frame_of_pair.begin());
    const bool found = it != frame_of_pair.end() && *it == frame_of_pair[i] + delta;
    if (found) pairs.emplace_back(i, j);
    i = found && options.pairs == RpePairs::kConsecutive ? j : i + 1;
  }
  return pairs;
}

const Eigen::Vector3d& PathPosition(const PosePair& pair, RpePathSource source) {
  return source == RpePathSource::kReference ? pair.reference.translation
                                             : pair.estimate.translation;
}

// Length of the step that leads to each pose; 0 for the first.
std::vector<double> StepLengths(std::span<const PosePair> aligned, RpePathSource source) {
  std::vector<double> steps(aligned.size(), 0.0);
  for (std::size_t i = 1; i < aligned.size(); ++i) {
    steps[i] = (PathPosition(aligned[i], source) - PathPosition(aligned[i - 1], source)).norm();
  }
  return steps;
}

IndexPairs ConsecutivePairsByMetres(const std::vector<double>& steps, double delta_m) {
  std::vector<std::size_t> marks;
  double since_mark = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    since_mark += steps[i];
    if (since_mark < delta_m) continue;
    marks.push_back(i);
    since_mark = 0.0;
  }
  IndexPairs pairs;
  for (std::size_t k = 1; k < marks.size(); ++k) pairs.emplace_back(marks[k - 1], marks[k]);
  return pairs;
}

IndexPairs AllPairsByMetres(const std::vector<double>& steps, double delta_m) {
  std::vector<double> path(steps);
  for (std::size_t i = 1; i < path.size(); ++i) path[i] += path[i - 1];
  IndexPairs pairs;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto it = std::lower_bound(path.begin(), path.end(), path[i] + delta_m);
    if (it == path.end()) break;
    pairs.emplace_back(i, static_cast<std::size_t>(it - path.begin()));
  }
  return pairs;
}

}  // namespace

IndexPairs ChooseRpePairs(std::span<const PosePair> aligned,
                          std::span<const std::int64_t> frame_of_pair, const RpeOptions& options) {
  LIFT_SLAM_CHECK(aligned.size() == frame_of_pair.size(), "{} pairs, {} frames", aligned.size(),
                  frame_of_pair.size());
  if (options.unit == RpeUnit::kFrames) return PairsByFrames(frame_of_pair, options);
  const std::vector<double> steps = StepLengths(aligned, options.path_source);
  return options.pairs == RpePairs::kAll ? AllPairsByMetres(steps, options.delta)
                                         : ConsecutivePairsByMetres(steps, options.delta);
}

std::optional<RelativePoseError> ComputeRelativePoseError(
    std::span<const PosePair> aligned, std::span<const std::int64_t> frame_of_pair,
    const RpeOptions& options) {
  std::vector<double> translations_m, rotations_deg;
  for (const auto& [i, j] : ChooseRpePairs(aligned, frame_of_pair, options)) {
    const Rigid3d reference_motion = Inverse(aligned[i].reference) * aligned[j].reference;
    const Rigid3d estimate_motion = Inverse(aligned[i].estimate) * aligned[j].estimate;
    const Rigid3d error = Inverse(reference_motion) * estimate_motion;
    translations_m.push_back(error.translation.norm());
    rotations_deg.push_back(RotationAngle(error.rotation) * 180.0 / std::numbers::pi);
  }
  const auto translation = Summarize(translations_m);
  const auto rotation = Summarize(rotations_deg);
  if (!translation || !rotation) return std::nullopt;
  return RelativePoseError{*translation, *rotation};
}

}  // namespace lift_slam
