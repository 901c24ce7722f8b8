#pragma once

#include <span>

#include "lift_slam/map/map.h"

namespace lift_slam {

struct FusionCounts {
  int observations_added = 0;
  int points_merged = 0;
};

// Projects map points into a keyframe; where a feature matches, the point gains an observation, or
// two points turn out to be one and are merged into the one seen more often.
FusionCounts FusePoints(std::span<const MapPointId> points, KeyFrameId keyframe, float radius_px,
                        float max_distance, Map& map);

}  // namespace lift_slam
