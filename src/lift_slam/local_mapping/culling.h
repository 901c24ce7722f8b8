#pragma once

#include <vector>

#include "lift_slam/local_mapping/local_mapper_options.h"
#include "lift_slam/map/map.h"

namespace lift_slam {

// Tests points made lately (ORB-SLAM sec. VI-B): seen in too few of the frames that should see
// them, or not by three keyframes once two more have come. Erases those that fail, drops from
// `recent` those that failed or passed. Returns how many were erased.
int CullRecentPoints(const LocalMapperOptions& options, Map& map, std::vector<MapPointId>& recent);

// Erases covisible keyframes most of whose points at least three others see as well on the same
// or a finer level (ORB-SLAM sec. VI-E); never the first keyframe nor the newest. Returns how many.
int CullKeyFrames(KeyFrameId newest, const LocalMapperOptions& options, Map& map);

}  // namespace lift_slam
