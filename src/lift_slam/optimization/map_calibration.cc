#include "lift_slam/optimization/map_calibration.h"

#include <algorithm>

#include "lift_slam/optimization/map_bundle_problem.h"

namespace lift_slam {
namespace {

struct Windows {
  std::vector<KeyFrameId> firsts, others;
};

// Evenly spread over the map, the first and the last keyframe among them; without overlap.
Windows SpreadWindows(const SelfCalibrationOptions& options, const Map& map) {
  const std::vector<KeyFrameId> ids = map.KeyFrameIds();
  const int length = std::max(2, options.window_keyframes);
  const int count = std::max(1, options.max_keyframes / length);
  const int slack = static_cast<int>(ids.size()) - length;
  Windows windows;
  for (int i = 0; i < count; ++i) {
    const int begin = count > 1 ? static_cast<int>(std::int64_t{i} * slack / (count - 1)) : 0;
    const auto first = ids.begin() + begin;
    windows.firsts.push_back(*first);
    windows.others.insert(windows.others.end(), first + 1, first + length);
  }
  return windows;
}

bool IsPossible(const SelfCalibrationOptions& options, const Map& map) {
  return options.enabled && map.num_keyframes() >= options.min_keyframes;
}

}  // namespace

bool IsCalibratedAsAWhole(const SelfCalibrationOptions& options, const Map& map) {
  return map.num_keyframes() <= std::max(options.max_keyframes, options.window_keyframes);
}

SelfCalibrationReport SelfCalibrateMap(const SelfCalibrationOptions& options, Map& map) {
  SelfCalibrationReport report;
  if (!IsPossible(options, map)) return report;
  BundleIndex index;
  BundleProblem problem = MakeBundleProblem(map.KeyFrameIds(), {}, map, index);
  report = SelfCalibrate(problem, options);
  if (report.usable) WritePosesAndPoints(index, problem, map);
  return report;
}

SelfCalibrationReport EstimateCalibration(const SelfCalibrationOptions& options, const Map& map) {
  if (!IsPossible(options, map)) return {};
  const Windows windows = SpreadWindows(options, map);
  BundleIndex index;
  BundleProblem problem = MakeBundleProblem(windows.others, windows.firsts, map, index);
  DropUndeterminedPoints(index, problem);
  return SelfCalibrate(problem, options);
}

}  // namespace lift_slam
