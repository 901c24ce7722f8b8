#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lift_slam/camera/camera.h"

namespace lift_slam {

// The viewing rays of all pixels of a camera, and between them.
class LensRays {
 public:
  explicit LensRays(const Camera& camera);

  int Width() const { return width_; }
  int Height() const { return height_; }
  // Ray through the centre of a pixel, -1 <= x <= width, -1 <= y <= height (a rim of one pixel
  // around the image); nothing where the camera has none. Unit length.
  std::optional<Eigen::Vector3d> At(int x, int y) const;
  // Ray through a place between pixel centres, from the four around it: distortion bends so little
  // within a pixel that this is exact to 0.001 pixels. Nothing when one of the four is missing.
  std::optional<Eigen::Vector3d> Between(double x, double y) const;

 private:
  int width_, height_;
  std::vector<Eigen::Vector3d> rays_;  // (height + 2) x (width + 2); zero: none
};

}  // namespace lift_slam
