#pragma once

#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/optimization/bundle_adjustment.h"
#include "lift_slam/optimization/self_calibration.h"

namespace lift_slam {

struct MapBundleReport {
  BundleReport solver;
  int free_keyframes = 0, fixed_keyframes = 0, points = 0, observations = 0;
  int outliers = 0;  // observations taken out of the map
};

// Optimises the poses of `free_keyframes` and all points they see; `fixed_keyframes` add their
// observations of those points. Observations that disagree in the end are removed from the map.
MapBundleReport AdjustBundle(const std::vector<KeyFrameId>& free_keyframes,
                             const std::vector<KeyFrameId>& fixed_keyframes,
                             const BundleOptions& options, Map& map);

// All keyframes and points; the first keyframe and, so that the scale cannot drift, no other is
// held fixed.
// The features' pixels in the map stay as measured; the bundle takes them with the correction.
MapBundleReport AdjustWholeMap(const BundleOptions& options,
                               const CalibrationCorrection& correction, Map& map);

}  // namespace lift_slam
