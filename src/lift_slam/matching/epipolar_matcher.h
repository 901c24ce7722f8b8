#pragma once

#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/matching/feature_matcher.h"

namespace lift_slam {

struct EpipolarMatchOptions {
  double max_epipolar_error_px = 2.0;  // on level 0; grows with the level's scale
  // Nearest over second nearest distance on the line: of bits, whose number grows as the square of
  // what a float descriptor calls distance, and of floats. Looser, crash barriers and road surfaces
  // give LIFT points with the wrong depth that agree with one another (docs/scale.md).
  double max_descriptor_ratio = 0.9;
  double max_descriptor_ratio_of_floats = 0.8;
  double min_epipole_distance_px = 10.0;  // too near the epipole a point's depth is unknown
};

// Matches features without map points of two keyframes along epipolar lines, for triangulation.
// Only points deeper than `min_depth` (map units, in a's camera) are looked for, which bounds the
// segment of the line. Each feature is used once. In order of a.
std::vector<FeatureMatch> MatchAlongEpipolarLines(const KeyFrame& a, const KeyFrame& b,
                                                  double min_depth, float max_distance,
                                                  const ViewModel& view,
                                                  const EpipolarMatchOptions& options);

}  // namespace lift_slam
