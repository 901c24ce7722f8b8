#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

enum class PoseState { kOk, kLost, kNotInitialized };

// One frame of a trajectory. The pose counts only when the state is kOk.
struct TrajectoryPose {
  std::int64_t frame_index = -1;  // index in the source sequence; -1: unknown
  std::int64_t timestamp_ns = 0;  // from the sequence, exact
  Rigid3d world_from_cam;         // camera to world, "T_wc"
  PoseState state = PoseState::kOk;
};

// Poses sorted by time.
using Trajectory = std::vector<TrajectoryPose>;

// Camera poses of a body trajectory (EuRoC): T_wc = T_wb T_bs.
Trajectory CameraFromBodyTrajectory(const Trajectory& world_from_body,
                                    const Rigid3d& body_from_cam);

}  // namespace lift_slam
