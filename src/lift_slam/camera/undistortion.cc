#include "lift_slam/camera/undistortion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "lift_slam/camera/distortion.h"

namespace lift_slam {
namespace {

using Eigen::Vector2d;

// Rays further off the axis than 85 degrees have no useful place on a pinhole's image plane.
const double kLargestTangent = std::tan(85.0 * std::numbers::pi / 180.0);

}  // namespace

UndistortionMap::UndistortionMap(const Camera& camera)
    : pinhole_(camera.pinhole),
      distortion_(camera.distortion),
      is_identity_(!camera.HasDistortion()),
      limit_(ValidLimit(camera.distortion)) {}

std::optional<Vector2d> UndistortionMap::Undistort(const Vector2d& pixel) const {
  if (!pixel.allFinite()) return std::nullopt;
  if (is_identity_) return pixel;
  const auto ideal = RemoveDistortion(distortion_, limit_, pinhole_.Unproject(pixel).head<2>());
  if (!ideal || ideal->squaredNorm() > kLargestTangent * kLargestTangent) return std::nullopt;
  return pinhole_.Project(ideal->homogeneous());
}

UndistortedBounds FindUndistortedBounds(const Camera& camera) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const UndistortionMap map(camera);
  UndistortedBounds bounds{kInfinity, -kInfinity, kInfinity, -kInfinity};
  const auto include = [&](double x, double y) {
    const auto pixel = map.Undistort({x, y});
    if (!pixel) return;
    bounds.min_x = std::min(bounds.min_x, pixel->x());
    bounds.max_x = std::max(bounds.max_x, pixel->x());
    bounds.min_y = std::min(bounds.min_y, pixel->y());
    bounds.max_y = std::max(bounds.max_y, pixel->y());
  };
  // A grid, not the border alone: where the border cannot be undistorted, the inside decides.
  constexpr int kSteps = 64;
  const PinholeIntrinsics& p = camera.pinhole;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      include(p.width * static_cast<double>(column) / kSteps - 0.5,
              p.height * static_cast<double>(row) / kSteps - 0.5);
    }
  }
  return bounds.min_x <= bounds.max_x ? bounds : UndistortedBounds{};
}

}  // namespace lift_slam
