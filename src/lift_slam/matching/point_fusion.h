#pragma once

#include <span>

#include "lift_slam/map/map.h"

namespace lift_slam {

struct FusionCounts {
  int observations_added = 0;
  int points_merged = 0;
};

// Which of two points that turn out to be one stays.
enum class FusionWinner {
  kMoreObserved,
  kGiven,  // the one that was projected
};

// Projects map points into a keyframe; where a feature matches, the point gains an observation, or
// two points turn out to be one and are merged.
FusionCounts FusePoints(std::span<const MapPointId> points, KeyFrameId keyframe, float radius_px,
                        float max_distance, Map& map,
                        FusionWinner winner = FusionWinner::kMoreObserved);

// Map::MergePoints, after which the observations that came along are aligned to the patch of the
// point that stays (where their images are kept).
void MergeAndAlignPoints(MapPointId from, MapPointId into, Map& map);

}  // namespace lift_slam
