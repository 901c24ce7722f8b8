#pragma once

#include "lift_slam/local_mapping/local_mapper_options.h"
#include "lift_slam/matching/point_fusion.h"

namespace lift_slam {

// Fuses the keyframe's points with those of its covisible keyframes and of theirs, both ways
// (ORB-SLAM sec. VI-C), and brings the look of its points up to date.
FusionCounts FuseWithNeighbors(KeyFrameId keyframe, const LocalMapperOptions& options, Map& map);

}  // namespace lift_slam
