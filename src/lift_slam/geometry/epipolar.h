#pragma once

#include <Eigen/Core>
#include <cmath>

#include "lift_slam/geometry/rigid3.h"

// Epipolar algebra on normalised image coordinates (x / z, y / z) of ideal pinhole cameras.
// Hartley and Zisserman, Multiple View Geometry, ch. 9 and 11.4.
namespace lift_slam {

// [v]x, so that CrossMatrix(v) * a = v x a.
inline Eigen::Matrix3d CrossMatrix(const Eigen::Vector3d& v) {
  return (Eigen::Matrix3d() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

// E = [t]x R with x2^T E x1 = 0; the translation is scaled to norm 1 (it must not be zero).
inline Eigen::Matrix3d EssentialMatrix(const Rigid3d& cam2_from_cam1) {
  return CrossMatrix(cam2_from_cam1.translation.normalized()) * cam2_from_cam1.RotationMatrix();
}

// The line in image 2 on which the match of a point of image 1 lies: (a, b, c) with
// a x + b y + c = 0.
inline Eigen::Vector3d EpipolarLine(const Eigen::Matrix3d& essential,
                                    const Eigen::Vector2d& normalized1) {
  return essential * normalized1.homogeneous();
}

// Squared distance of a point to a line, in the units of the point squared. Infinite for the line
// of the epipole itself, (0, 0, c), which is no line in the image.
inline double SquaredDistanceToLine(const Eigen::Vector3d& line, const Eigen::Vector2d& point) {
  const double residual = line.dot(point.homogeneous());
  return residual * residual / line.head<2>().squaredNorm();
}

// First-order approximation of the squared distance (both images together) to the nearest pair
// that fulfils the epipolar constraint: Sampson error, eq. (11.9). With noise of standard
// deviation s in each coordinate it is s^2 chi-square distributed with 1 degree of freedom.
inline double SquaredSampsonError(const Eigen::Matrix3d& essential,
                                  const Eigen::Vector2d& normalized1,
                                  const Eigen::Vector2d& normalized2) {
  const Eigen::Vector3d line2 = essential * normalized1.homogeneous();
  const Eigen::Vector2d line1 = essential.topLeftCorner<2, 2>().transpose() * normalized2 +
                                essential.row(2).head<2>().transpose();
  const double residual = line2.dot(normalized2.homogeneous());
  return residual * residual / (line2.head<2>().squaredNorm() + line1.squaredNorm());
}

}  // namespace lift_slam
