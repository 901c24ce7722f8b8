#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

Trajectory CameraFromBodyTrajectory(const Trajectory& world_from_body,
                                    const Rigid3d& body_from_cam) {
  Trajectory world_from_cam = world_from_body;
  for (TrajectoryPose& pose : world_from_cam) {
    pose.world_from_cam = pose.world_from_cam * body_from_cam;
  }
  return world_from_cam;
}

}  // namespace lift_slam
