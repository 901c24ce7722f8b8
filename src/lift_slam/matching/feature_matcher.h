#pragma once

#include <vector>

#include "lift_slam/map/frame_features.h"

namespace lift_slam {

struct FeatureMatch {
  int a = -1, b = -1;  // feature indices
};

// Matches for initialisation: features of `a` looked for in `b` within a window around
// `expected_in_b[i]` (undistorted pixels), mutual nearest neighbours with ratio and rotation
// checks, levels at most view.level_tolerance apart. In order of a.
std::vector<FeatureMatch> MatchWithinWindow(const FrameFeatures& a, const FrameFeatures& b,
                                            const std::vector<Eigen::Vector2f>& expected_in_b,
                                            float radius_px, const ViewModel& view);

}  // namespace lift_slam
