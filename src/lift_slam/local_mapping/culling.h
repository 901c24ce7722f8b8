#pragma once

#include <vector>

#include "lift_slam/local_mapping/local_mapper_options.h"
#include "lift_slam/map/map.h"

namespace lift_slam {

// A point, and how many keyframes had been mapped when it was made, its own included.
struct RecentPoint {
  MapPointId id;
  int made_at = 0;
};

// Erased points, by reason.
struct CulledPoints {
  int rarely_found = 0;   // seen in too few of the frames that should see them
  int few_observers = 0;  // not seen by three keyframes once two more have come
};

// Tests points made lately (ORB-SLAM sec. VI-B). Erases those that fail, drops from `recent` those
// that failed or passed. `num_mapped`: keyframes mapped so far, the newest included; ids say
// nothing of it where maps have been merged.
CulledPoints CullRecentPoints(const LocalMapperOptions& options, int num_mapped, Map& map,
                              std::vector<RecentPoint>& recent);

// Erases covisible keyframes most of whose points at least three others see as well on the same
// or a finer level (ORB-SLAM sec. VI-E); never the first keyframe nor the newest. Returns how many.
int CullKeyFrames(KeyFrameId newest, const LocalMapperOptions& options, Map& map);

}  // namespace lift_slam
