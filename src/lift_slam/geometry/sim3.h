#pragma once

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// A similarity x_in_target = scale * rotation * x_in_source + translation, scale > 0.
struct Sim3d {
  double scale = 1.0;
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Sim3d() = default;
  Sim3d(double s, const Eigen::Quaterniond& r, const Eigen::Vector3d& t)
      : scale(s), rotation(r.normalized()), translation(t) {}
};

inline Eigen::Vector3d operator*(const Sim3d& target_from_source, const Eigen::Vector3d& x) {
  return target_from_source.scale * (target_from_source.rotation * x) +
         target_from_source.translation;
}

inline Sim3d operator*(const Sim3d& c_from_b, const Sim3d& b_from_a) {
  return {c_from_b.scale * b_from_a.scale, c_from_b.rotation * b_from_a.rotation,
          c_from_b * b_from_a.translation};
}

inline Sim3d Inverse(const Sim3d& b_from_a) {
  const Eigen::Quaterniond inverse = b_from_a.rotation.conjugate();
  return {1.0 / b_from_a.scale, inverse, -(inverse * b_from_a.translation) / b_from_a.scale};
}

// The camera pose in a world that `new_from_old` has moved and scaled: world_from_cam goes through
// the similarity, its rotation and its position; the scale stays with the world's points.
inline Rigid3d TransformWorld(const Rigid3d& world_from_cam, const Sim3d& new_from_old) {
  return {new_from_old.rotation * world_from_cam.rotation,
          new_from_old * world_from_cam.translation};
}

}  // namespace lift_slam
