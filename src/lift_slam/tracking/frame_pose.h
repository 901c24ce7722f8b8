#pragma once

#include "lift_slam/map/map.h"
#include "lift_slam/optimization/pose_optimization.h"

namespace lift_slam {

// Optimises the frame's pose from its matches, and from where it is expected if so, and takes away
// the matches that disagree with it. Returns the number of matches left.
int OptimizeFramePose(const Map& map, const PoseOptimizationOptions& options, Frame& frame,
                      const CenterPrior& prior = {});

}  // namespace lift_slam
