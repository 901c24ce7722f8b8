#pragma once

#include <memory>
#include <vector>

#include "lift_slam/slam/map_session.h"
#include "lift_slam/slam/run_record.h"

namespace lift_slam {

// Adds trajectories, keyframes and points of the maps kept to a record that holds the frames.
// Poses are those of the maps as they are now: a frame is its pose relative to its reference
// keyframe times that keyframe's pose.
void CompleteRunRecord(const std::vector<std::unique_ptr<MapSession>>& sessions, RunRecord& record);

}  // namespace lift_slam
