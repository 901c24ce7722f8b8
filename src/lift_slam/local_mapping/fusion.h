#pragma once

#include "lift_slam/local_mapping/local_mapper_options.h"
#include "lift_slam/matching/point_fusion.h"

namespace lift_slam {

// Fuses the keyframe's points with those of its covisible keyframes and of theirs, both ways
// (ORB-SLAM sec. VI-C), and brings the look of its points up to date. `max_distance`
// is of descriptors.
FusionCounts FuseWithNeighbors(KeyFrameId keyframe, const LocalMapperOptions& options,
                               float max_distance, Map& map);

}  // namespace lift_slam
