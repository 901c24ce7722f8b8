#pragma once

#include <Eigen/Core>

namespace lift_slam {

// An ideal pinhole without distortion. Pixel (0, 0) is the CENTRE of the top-left pixel.
// Camera frame: x right, y down, z forward.
struct PinholeIntrinsics {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  // pixels
  int width = 0, height = 0;                      // pixels

  // Pixel of a point in front of the camera (z > 0).
  Eigen::Vector2d Project(const Eigen::Vector3d& x_in_cam) const {
    return {fx * x_in_cam.x() / x_in_cam.z() + cx, fy * x_in_cam.y() / x_in_cam.z() + cy};
  }
  // The viewing ray, scaled to z = 1.
  Eigen::Vector3d Unproject(const Eigen::Vector2d& pixel) const {
    return {(pixel.x() - cx) / fx, (pixel.y() - cy) / fy, 1.0};
  }
  Eigen::Matrix3d Matrix() const {
    return (Eigen::Matrix3d() << fx, 0, cx, 0, fy, cy, 0, 0, 1).finished();
  }
};

}  // namespace lift_slam
