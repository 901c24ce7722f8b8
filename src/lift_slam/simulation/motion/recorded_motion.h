#pragma once

#include <vector>

#include "lift_slam/geometry/trajectory.h"
#include "lift_slam/simulation/motion/camera_motion.h"

namespace lift_slam {

// A motion through given poses of the camera in the scene frame: it passes exactly through each at
// its time, positions by cubic Hermite curves (no jump in velocity), rotations by the shortest
// turn. Time 0 is the first pose's.
class RecordedMotion : public CameraMotion {
 public:
  // Poses that are not kOk are left out. Throws InputError when none is left.
  explicit RecordedMotion(const Trajectory& world_from_cam);

  Rigid3d WorldFromCam(double time_s) const override;
  double DurationS() const override { return poses_.back().time_s; }

  // Times of the given poses.
  std::vector<std::int64_t> TimesNs() const;

 private:
  struct TimedPose {
    std::int64_t time_ns;
    double time_s;
    Rigid3d world_from_cam;
    Eigen::Vector3d velocity;  // of the curve, metres a second
  };
  void SetVelocities();

  std::vector<TimedPose> poses_;
};

// The poses turned, shifted and scaled so that the first becomes `start`; `scale` multiplies the
// distances.
Trajectory MovedToStart(const Trajectory& trajectory, const Rigid3d& start, double scale);

}  // namespace lift_slam
