#include "lift_slam/loop_closing/place_sighting.h"

#include <algorithm>

#include "lift_slam/matching/frame_matcher.h"
#include "lift_slam/util/median.h"

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

void CountParts(const Map& map, const std::vector<MapPointId>& visible, const Frame& frame,
                Sighting& sighting) {
  std::vector<MapPointId> found;
  for (const MapPointId id : frame.map_points) {
    if (id.valid()) found.push_back(id);
  }
  std::ranges::sort(found);
  std::vector<Eigen::Vector3d> in_cam;
  std::vector<double> depths;
  for (const MapPointId id : visible) {
    in_cam.push_back(frame.cam_from_world * map.point(id).position);
    depths.push_back(in_cam.back().z());
  }
  if (visible.empty()) return;
  const double middle_depth = Median(depths);
  const double middle_x = 0.5 * map.view().pinhole.width;
  for (std::size_t i = 0; i < visible.size(); ++i) {
    const bool is_far = in_cam[i].z() > middle_depth;
    const bool is_right = map.view().pinhole.Project(in_cam[i]).x() > middle_x;
    SightingCount& part = sighting.parts[2U * is_far + is_right];
    const bool is_found = std::ranges::binary_search(found, visible[i]);
    for (SightingCount* count : {&part, &sighting.all}) {
      ++count->num_visible;
      count->num_found += is_found;
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
  CountParts(map, matched.visible, frame, sighting);
  sighting.points = std::move(frame.map_points);
  return sighting;
}

std::optional<double> LeastPartRatio(const SightingParts& parts, const SightingParts& usual,
                                     int min_visible) {
  std::optional<double> least;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool says_something = std::min(parts[i].num_visible, usual[i].num_visible) >= min_visible;
    if (!says_something || usual[i].num_found == 0) continue;
    const double ratio = parts[i].FoundRatio() / usual[i].FoundRatio();
    least = std::min(least.value_or(ratio), ratio);
  }
  return least;
}

}  // namespace lift_slam
