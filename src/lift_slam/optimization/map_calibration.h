#pragma once

#include "lift_slam/map/map.h"
#include "lift_slam/optimization/self_calibration.h"

namespace lift_slam {

// Whether the map is short enough for one bundle with the correction in it (SelfCalibrateMap); else
// EstimateCalibration and AdjustWholeMap with its result.
bool IsCalibratedAsAWhole(const SelfCalibrationOptions& options, const Map& map);

// All keyframes and points together with a correction of the calibration. The features' pixels in
// the map stay as measured: whoever projects afterwards applies the correction. Where it is refused
// the map stays as it is.
SelfCalibrationReport SelfCalibrateMap(const SelfCalibrationOptions& options, Map& map);

// The correction that windows of consecutive keyframes agree on (Consensus), each adjusted by
// itself with its first pose held fixed; kNoEstimate where fewer than two have a result. Costs and
// iterations stay zero. The map stays as it is.
SelfCalibrationReport EstimateCalibration(const SelfCalibrationOptions& options, const Map& map);

}  // namespace lift_slam
