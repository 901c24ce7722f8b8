#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace lift_slam {

// [v]x, with [v]x w = v.cross(w).
inline Eigen::Matrix3d SkewSymmetric(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

// The rotation by |w| radians about w.
inline Eigen::Quaterniond ExpSo3(const Eigen::Vector3d& w) {
  const double squared_angle = w.squaredNorm();
  // sin(a / 2) / a, by its series where the division would lose digits.
  const double angle = std::sqrt(squared_angle);
  const double factor = angle < 1e-4 ? 0.5 - squared_angle / 48.0 : std::sin(0.5 * angle) / angle;
  return Eigen::Quaterniond(std::cos(0.5 * angle), factor * w.x(), factor * w.y(), factor * w.z())
      .normalized();
}

// Left Jacobian of SO(3): Exp(w + d) = Exp(J d) Exp(w) to first order in d.
// J = I + (1 - cos a) / a^2 [w]x + (a - sin a) / a^3 [w]x^2 with a = |w|.
inline Eigen::Matrix3d LeftJacobianSo3(const Eigen::Vector3d& w) {
  const double squared_angle = w.squaredNorm();
  const double angle = std::sqrt(squared_angle);
  const bool is_small = angle < 1e-3;
  const double first =
      is_small ? 0.5 - squared_angle / 24.0 : (1.0 - std::cos(angle)) / squared_angle;
  const double second = is_small ? 1.0 / 6.0 - squared_angle / 120.0
                                 : (angle - std::sin(angle)) / (squared_angle * angle);
  const Eigen::Matrix3d skew = SkewSymmetric(w);
  return Eigen::Matrix3d::Identity() + first * skew + second * skew * skew;
}

}  // namespace lift_slam
