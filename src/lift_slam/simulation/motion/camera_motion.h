#pragma once

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// A camera's pose as a function of time. World: the scene frame (z up); camera: x right, y down,
// z forward.
class CameraMotion {
 public:
  virtual ~CameraMotion() = default;
  // 0 <= time_s <= DurationS(); a little outside (exposure of the last frame) is clamped.
  virtual Rigid3d WorldFromCam(double time_s) const = 0;
  virtual double DurationS() const = 0;
};

}  // namespace lift_slam
