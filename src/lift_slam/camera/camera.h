#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lift_slam/camera/pinhole.h"

namespace lift_slam {

// Distortion acts on normalised image coordinates (x / z, y / z), as in OpenCV.
struct NoDistortion {};
// Radial k1 k2 k3 and tangential p1 p2 (OpenCV's model, KITTI raw, EuRoC, TUM RGB-D).
struct RadialTangential {
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;
};
// Kannala-Brandt fisheye, theta_d = theta (1 + k1 theta^2 + ... + k4 theta^8) (OpenCV's fisheye).
struct KannalaBrandt {
  double k1 = 0.0, k2 = 0.0, k3 = 0.0, k4 = 0.0;
};
// One-parameter field-of-view model of Devernay and Faugeras (TUM-mono); omega in radians.
struct FieldOfView {
  double omega = 0.0;
};
using Distortion = std::variant<NoDistortion, RadialTangential, KannalaBrandt, FieldOfView>;

// A calibrated camera: pinhole parameters and a distortion.
// Pixel (0, 0) is the CENTRE of the top-left pixel; camera frame x right, y down, z forward.
struct Camera {
  PinholeIntrinsics pinhole;
  Distortion distortion;
  double frame_rate_hz = 0.0;  // nominal; 0: unknown
  std::string source{};        // file the calibration came from, for messages and reports

  // Pixel of a point; nothing when it is behind the camera or outside the model's valid range.
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& x_in_cam) const;
  // Unit viewing ray of a (distorted) pixel; nothing where the distortion cannot be inverted.
  std::optional<Eigen::Vector3d> Unproject(const Eigen::Vector2d& pixel) const;
  // The pixel that an ideal pinhole with the same fx, fy, cx, cy would see; nothing where the ray
  // cannot be found or is more than 85 degrees off the optical axis.
  std::optional<Eigen::Vector2d> Undistort(const Eigen::Vector2d& pixel) const;
  bool HasDistortion() const;
  // "pinhole", "radial_tangential", "kannala_brandt" or "fov".
  std::string ModelName() const;
  // Throws InputError naming `source` when a focal length or size is not positive or not finite,
  // or the principal point lies outside the image.
  void Check() const;
};

}  // namespace lift_slam
