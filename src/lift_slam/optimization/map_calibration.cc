#include "lift_slam/optimization/map_calibration.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "lift_slam/optimization/calibration_consensus.h"
#include "lift_slam/optimization/map_bundle_problem.h"

namespace lift_slam {
namespace {

using Window = std::vector<KeyFrameId>;  // consecutive keyframes

// Evenly spread over the map, the first and the last keyframe among them; without overlap.
std::vector<Window> SpreadWindows(const SelfCalibrationOptions& options, const Map& map) {
  const std::vector<KeyFrameId> ids = map.KeyFrameIds();
  const int length = std::max(2, std::min(options.window_keyframes, options.max_keyframes / 2));
  const int count = std::max(2, options.max_keyframes / length);
  const int slack = static_cast<int>(ids.size()) - length;
  std::vector<Window> windows;
  for (int i = 0; i < count; ++i) {
    const auto begin = static_cast<int>(std::int64_t{i} * slack / (count - 1));
    windows.emplace_back(ids.begin() + begin, ids.begin() + begin + length);
  }
  return windows;
}

SelfCalibrationReport EstimateFrom(const Window& window, const SelfCalibrationOptions& options,
                                   const Map& map) {
  BundleIndex index;
  BundleProblem problem =
      MakeBundleProblem({window.begin() + 1, window.end()}, {window.front()}, map, index);
  DropUndeterminedPoints(index, problem);
  return SelfCalibrate(problem, options);
}

// A calibration that is not clearly off stays as it is.
void RefuseSmallCorrection(const SelfCalibrationOptions& options, SelfCalibrationReport& report) {
  if (report.usable() && !IsClearlyOff(report.estimate, options)) {
    report.refusal = CalibrationRefusal::kNotClearlyOff;
  }
}

// kNone: nothing speaks against it before it is tried.
CalibrationRefusal RefusalOf(const SelfCalibrationOptions& options, const Map& map) {
  if (!options.enabled) return CalibrationRefusal::kSwitchedOff;
  if (map.num_keyframes() < options.min_keyframes) return CalibrationRefusal::kFewKeyFrames;
  return CalibrationRefusal::kNone;
}

}  // namespace

bool IsCalibratedAsAWhole(const SelfCalibrationOptions& options, const Map& map) {
  return map.num_keyframes() <= std::max(options.max_keyframes, options.window_keyframes);
}

SelfCalibrationReport SelfCalibrateMap(const SelfCalibrationOptions& options, Map& map) {
  SelfCalibrationReport report{.refusal = RefusalOf(options, map)};
  if (!report.usable()) return report;
  BundleIndex index;
  BundleProblem problem = MakeBundleProblem(map.KeyFrameIds(), {}, map, index);
  report = SelfCalibrate(problem, options);
  RefuseSmallCorrection(options, report);
  if (report.usable()) WritePosesAndPoints(index, problem, map);
  return report;
}

SelfCalibrationReport EstimateCalibration(const SelfCalibrationOptions& options, const Map& map) {
  SelfCalibrationReport report{.refusal = RefusalOf(options, map)};
  if (!report.usable()) return report;
  std::vector<CalibrationCorrection> parts;
  for (const Window& window : SpreadWindows(options, map)) {
    const SelfCalibrationReport part = EstimateFrom(window, options, map);
    if (part.usable()) parts.push_back(part.estimate);
  }
  if (parts.size() < 2) return {.refusal = CalibrationRefusal::kNoEstimate};
  report.estimate = Consensus(parts, options);
  RefuseSmallCorrection(options, report);
  return report;
}

}  // namespace lift_slam
