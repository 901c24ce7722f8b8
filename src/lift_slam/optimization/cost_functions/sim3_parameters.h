#pragma once

#include <ceres/rotation.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "lift_slam/geometry/sim3.h"

namespace lift_slam {

// A similarity of numbers that may carry derivatives (ceres::Jet).
template <class T>
struct GenericSim3 {
  T scale;
  Eigen::Quaternion<T> rotation;
  Eigen::Matrix<T, 3, 1> translation;

  Eigen::Matrix<T, 3, 1> operator*(const Eigen::Matrix<T, 3, 1>& x) const {
    return (rotation * x) * scale + translation;
  }
  GenericSim3 operator*(const GenericSim3& b_from_a) const {
    return {scale * b_from_a.scale, rotation * b_from_a.rotation, *this * b_from_a.translation};
  }
  GenericSim3 Inverse() const {
    const Eigen::Quaternion<T> inverse = rotation.conjugate();
    const Eigen::Matrix<T, 3, 1> turned = inverse * translation;
    return {T(1.0) / scale, inverse, turned * (T(-1.0) / scale)};
  }
};

template <class T>
GenericSim3<T> Cast(const Sim3d& similarity) {
  return {T(similarity.scale), similarity.rotation.cast<T>(), similarity.translation.cast<T>()};
}

// A parameter block of 7: a change [w (3), d (3), l] of the target frame, x' = e^l Exp(w) x + d. As
// many parameters as degrees of freedom; at 0 nothing changes.
inline constexpr int kSim3Parameters = 7;
inline constexpr int kLogScaleParameter = 6;

// Constant residual of a point behind the camera, which makes a solver take back the step.
inline constexpr double kSim3BehindSigmas = 100.0;

// Whether a change of scale can be evaluated: farther astray its inverse is infinite.
template <class T>
bool IsScaleNear(const T& log_scale) {
  constexpr double kMaxLogScale = 20.0;
  return log_scale > T(-kMaxLogScale) && log_scale < T(kMaxLogScale);
}

template <class T>
GenericSim3<T> Sim3FromParameters(const T* parameters) {
  using std::exp;
  T rotation[4];  // w x y z
  ceres::AngleAxisToQuaternion(parameters, rotation);
  return {exp(parameters[kLogScaleParameter]),
          Eigen::Quaternion<T>(rotation[0], rotation[1], rotation[2], rotation[3]),
          Eigen::Matrix<T, 3, 1>(parameters[3], parameters[4], parameters[5])};
}

// The changed similarity.
inline Sim3d ApplySim3Change(const double* parameters, const Sim3d& target_from_source) {
  const GenericSim3<double> change = Sim3FromParameters(parameters);
  return Sim3d(change.scale, change.rotation, change.translation) * target_from_source;
}

}  // namespace lift_slam
