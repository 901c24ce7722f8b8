#pragma once

#include <Eigen/Core>

#include "lift_slam/camera/pinhole.h"

namespace lift_slam {

// A picture that OpenGL draws: a pinhole looking some way from the camera's centre. Sample (0, 0)
// is the centre of the top-left sample. View frame: x right, y down, z forward.
struct PinholeView {
  PinholeIntrinsics pinhole;  // in samples
  Eigen::Matrix3d view_from_cam = Eigen::Matrix3d::Identity();
};

// The depth buffer holds d = near (far / z - 1) / (far - near): 1 at near, 0 at far and for the
// sky, evenly precise in z because floats are densest around 0.
struct DepthRange {
  double near_m = 0.1;
  double far_m = 3000.0;

  // 1 / z of a value of the depth buffer, 1 / m.
  float InverseDepth(float buffer_value) const {
    return buffer_value * static_cast<float>((far_m - near_m) / (near_m * far_m)) +
           static_cast<float>(1.0 / far_m);
  }
};

// Clip coordinates of a point relative to the camera's centre, in the scene's axes. Row 0 of the
// frame buffer is the top row.
Eigen::Matrix4d ClipFromEye(const PinholeView& view, const Eigen::Matrix3d& cam_from_scene,
                            const DepthRange& range);

// Scene ray (scaled to z = 1 in the view) of normalised device coordinates (x, y, 1).
Eigen::Matrix3d SceneFromNdc(const PinholeView& view, const Eigen::Matrix3d& cam_from_scene);

}  // namespace lift_slam
