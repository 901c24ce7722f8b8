#pragma once

#include <string>

#include "lift_slam/camera/camera.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

enum class CameraModel { kPinhole, kRadialTangential, kKannalaBrandt, kFieldOfView };

// A camera as options; the defaults are those of KITTI odometry's grey cameras.
struct CameraOptions {
  CameraModel model = CameraModel::kPinhole;
  int width = 1241, height = 376;
  double fx = 718.856, fy = 718.856, cx = 607.1928, cy = 185.2157;
  // As the model needs them, else 0: k1 k2 p1 p2 k3 (radial_tangential), k1 k2 k3 k4
  // (kannala_brandt), omega (fov).
  double k1 = 0.0, k2 = 0.0, k3 = 0.0, k4 = 0.0, p1 = 0.0, p2 = 0.0, omega = 0.0;
  double rate_hz = 10.0;

  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field

  Camera ToCamera() const;
  // Takes everything of a calibration; its rate only when it has one.
  void Set(const Camera& camera);
  // The same view from left to right in another size; pixels keep their shape, so another aspect
  // ratio shows more or less at the top and bottom alike.
  void ScaleTo(int new_width, int new_height);
};

}  // namespace lift_slam
