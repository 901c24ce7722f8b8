#include "lift_slam/matching/point_projection.h"

#include <cmath>

namespace lift_slam {
namespace {

constexpr double kMinViewingCosine = 0.5;
// Slack on the range of distances, as the level it comes from is rounded.
constexpr double kDistanceSlack = 1.25;

}  // namespace

std::optional<PointProjection> ProjectPoint(const ViewModel& view, const MapPoint& point,
                                            const Rigid3d& cam_from_world) {
  const Eigen::Vector3d in_cam = cam_from_world * point.position;
  if (in_cam.z() <= 0.0) return std::nullopt;
  PointProjection projection;
  projection.pixel = view.pinhole.Project(in_cam);
  if (!view.Covers(projection.pixel)) return std::nullopt;

  const double distance = in_cam.norm();
  if (distance > kDistanceSlack * point.max_distance ||
      distance < point.min_distance / kDistanceSlack) {
    return std::nullopt;
  }
  projection.viewing_cosine = (cam_from_world.rotation * point.normal).dot(in_cam) / distance;
  if (projection.viewing_cosine < kMinViewingCosine) return std::nullopt;

  const double level = std::ceil(
      std::log(point.max_distance / distance) / std::log(view.levels.scale_factor) - 1e-9);
  projection.level = std::clamp(static_cast<int>(level), 0, view.levels.num_levels - 1);
  return projection;
}

}  // namespace lift_slam
