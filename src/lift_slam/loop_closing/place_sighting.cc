#include "lift_slam/loop_closing/place_sighting.h"

#include <utility>

#include "lift_slam/matching/frame_matcher.h"

namespace lift_slam {
namespace {

bool Agrees(const ViewModel& view, const MapPoint& point, const Frame& frame, int feature,
            double max_squared_error) {
  const Eigen::Vector3d in_cam = frame.cam_from_world * point.position;
  if (!(in_cam.z() > 0.0)) return false;
  const double squared_error =
      (view.pinhole.Project(in_cam) - frame.features->pixel(feature)).squaredNorm();
  return squared_error * view.InverseVariance(frame.features->level(feature), false) <=
         max_squared_error;
}

void DropThoseThatDisagree(const Map& map, double max_squared_error, Frame& frame) {
  for (std::size_t i = 0; i < frame.map_points.size(); ++i) {
    const MapPoint* point = map.FindPoint(frame.map_points[i]);
    if (point != nullptr &&
        !Agrees(map.view(), *point, frame, static_cast<int>(i), max_squared_error)) {
      frame.map_points[i] = MapPointId();
    }
  }
}

}  // namespace

Sighting FindPoints(const Map& map, std::span<const MapPointId> points, const KeyFrame& keyframe,
                    const Rigid3d& cam_from_world, const SightingOptions& options) {
  Frame frame(keyframe.frame_index, keyframe.timestamp_ns, keyframe.features);
  frame.cam_from_world = cam_from_world;
  const LocalMatchResult matched =
      MatchLocalPoints(map, points, static_cast<float>(options.search_radius_factor),
                       map.view().thresholds.loose.low, frame);
  DropThoseThatDisagree(map, options.max_squared_error, frame);
  Sighting sighting;
  sighting.num_visible = static_cast<int>(matched.visible.size());
  sighting.num_found = frame.CountMatches();
  sighting.points = std::move(frame.map_points);
  return sighting;
}

}  // namespace lift_slam
