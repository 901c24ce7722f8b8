#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace lift_slam {

// A rigid transform x_in_target = rotation * x_in_source + translation.
// Named target_from_source: cam_from_world * point_in_world = point_in_cam.
struct Rigid3d {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  // unit norm
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Rigid3d() = default;
  Rigid3d(const Eigen::Quaterniond& r, const Eigen::Vector3d& t)
      : rotation(r.normalized()), translation(t) {}
  Rigid3d(const Eigen::Matrix3d& r, const Eigen::Vector3d& t)
      : rotation(Eigen::Quaterniond(r).normalized()), translation(t) {}

  Eigen::Matrix3d RotationMatrix() const { return rotation.toRotationMatrix(); }
  // The target frame's origin in source coordinates: for cam_from_world the camera centre in the
  // world.
  Eigen::Vector3d TargetOriginInSource() const { return -(rotation.conjugate() * translation); }
};

inline Eigen::Vector3d operator*(const Rigid3d& target_from_source,
                                 const Eigen::Vector3d& x_in_source) {
  return target_from_source.rotation * x_in_source + target_from_source.translation;
}

inline Rigid3d operator*(const Rigid3d& c_from_b, const Rigid3d& b_from_a) {
  return {c_from_b.rotation * b_from_a.rotation,
          c_from_b.rotation * b_from_a.translation + c_from_b.translation};
}

inline Rigid3d Inverse(const Rigid3d& b_from_a) {
  const Eigen::Quaterniond inverse = b_from_a.rotation.conjugate();
  return {inverse, -(inverse * b_from_a.translation)};
}

// Angle of the rotation in radians, in [0, pi].
inline double RotationAngle(const Eigen::Quaterniond& rotation) {
  return 2.0 * std::atan2(rotation.vec().norm(), std::abs(rotation.w()));
}

}  // namespace lift_slam
