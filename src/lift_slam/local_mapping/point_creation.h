#pragma once

#include <vector>

#include "lift_slam/local_mapping/local_mapper_options.h"
#include "lift_slam/map/map.h"

namespace lift_slam {

// Triangulates features without map points of the keyframe against its best covisible keyframes.
// Returns the new points in order of creation. `max_distance` is of descriptors.
std::vector<MapPointId> CreatePoints(KeyFrameId keyframe, const LocalMapperOptions& options,
                                     float max_distance, Map& map);

}  // namespace lift_slam
