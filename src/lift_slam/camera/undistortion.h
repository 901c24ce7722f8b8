#pragma once

#include <Eigen/Core>
#include <optional>

#include "lift_slam/camera/camera.h"

namespace lift_slam {

// A rectangle in the pixels of the ideal pinhole (same fx, fy, cx, cy, no distortion). May reach
// below 0 and beyond the image size.
struct UndistortedBounds {
  double min_x = 0.0, max_x = 0.0, min_y = 0.0, max_y = 0.0;

  bool Contains(const Eigen::Vector2d& pixel) const {
    return pixel.x() >= min_x && pixel.x() <= max_x && pixel.y() >= min_y && pixel.y() <= max_y;
  }
};

// Undistorts the many keypoints of every frame of one camera: what depends on the camera alone is
// computed once. Immutable, so one object serves all threads.
class UndistortionMap {
 public:
  explicit UndistortionMap(const Camera& camera);

  // As Camera::Undistort; the same pixel, to the bit, for a camera without distortion.
  std::optional<Eigen::Vector2d> Undistort(const Eigen::Vector2d& pixel) const;
  bool IsIdentity() const { return is_identity_; }

 private:
  PinholeIntrinsics pinhole_;
  Distortion distortion_;
  bool is_identity_ = true;
  double limit_ = 0.0;  // ValidLimit
};

// The rectangle that the undistorted pixels of the whole image span, outer edges of the border
// pixels included ((-0.5, -0.5) to (width - 0.5, height - 0.5) without distortion). Parts that
// cannot be undistorted are left out.
UndistortedBounds FindUndistortedBounds(const Camera& camera);

}  // namespace lift_slam
