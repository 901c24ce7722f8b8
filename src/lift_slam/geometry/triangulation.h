#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <span>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// One view of a point: the camera's pose and the normalised image coordinates (x / z, y / z).
struct PointView {
  Rigid3d cam_from_world;
  Eigen::Vector2d normalized = Eigen::Vector2d::Zero();
};

// Linear triangulation (DLT on unit rays) of two or more views; about a microsecond for two.
// Solved relative to the camera centres and in units of their spread, so that the place of the
// world's origin and its scale do not matter. World coordinates. Returns nothing when all centres
// coincide or the rays meet at infinity; depth signs are not checked.
std::optional<Eigen::Vector3d> TriangulatePoint(std::span<const PointView> views);

// The same for two views in the first camera's frame.
std::optional<Eigen::Vector3d> TriangulatePoint(const Rigid3d& cam2_from_cam1,
                                                const Eigen::Vector2d& normalized1,
                                                const Eigen::Vector2d& normalized2);

// Angle between two directions of any length, radians in [0, pi]; exact for small angles as well.
double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// The angle under which a point sees two camera centres, radians in [0, pi].
double ParallaxAngle(const Eigen::Vector3d& centre1, const Eigen::Vector3d& centre2,
                     const Eigen::Vector3d& point);

// Squared reprojection error in normalised units (multiply by the focal length squared for
// pixels squared); infinite when the point is not in front of the camera.
inline double SquaredReprojectionError(const Rigid3d& cam_from_world, const Eigen::Vector3d& point,
                                       const Eigen::Vector2d& normalized) {
  const Eigen::Vector3d in_cam = cam_from_world * point;
  if (!(in_cam.z() > 0.0)) return std::numeric_limits<double>::infinity();
  return (in_cam.head<2>() / in_cam.z() - normalized).squaredNorm();
}

}  // namespace lift_slam
