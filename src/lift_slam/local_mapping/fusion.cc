#include "lift_slam/local_mapping/fusion.h"

#include <algorithm>

namespace lift_slam {
namespace {

std::vector<KeyFrameId> FusionTargets(KeyFrameId keyframe, const LocalMapperOptions& options,
                                      const Map& map) {
  const CovisibilityGraph& graph = map.covisibility();
  std::vector<KeyFrameId> targets;
  const auto add = [&](KeyFrameId id) {
    if (id != keyframe && std::find(targets.begin(), targets.end(), id) == targets.end()) {
      targets.push_back(id);
    }
  };
  const auto first = graph.Neighbors(keyframe, 1, options.fusion_neighbors);
  for (const auto& neighbor : first) add(neighbor.keyframe);
  for (const auto& neighbor : first) {
    for (const auto& second :
         graph.Neighbors(neighbor.keyframe, 1, options.fusion_second_neighbors)) {
      add(second.keyframe);
    }
  }
  return targets;
}

void AppendPoints(const KeyFrame& keyframe, std::vector<MapPointId>& points) {
  for (const MapPointId id : keyframe.map_points) {
    if (id.valid()) points.push_back(id);
  }
}

}  // namespace

FusionCounts FuseWithNeighbors(KeyFrameId keyframe, const LocalMapperOptions& options,
                               float max_distance, Map& map) {
  const auto radius = static_cast<float>(options.fusion_radius_px);
  const std::vector<KeyFrameId> targets = FusionTargets(keyframe, options, map);
  FusionCounts total;
  const auto fuse = [&](const std::vector<MapPointId>& points, KeyFrameId into) {
    const FusionCounts counts = FusePoints(points, into, radius, max_distance, map);
    total.observations_added += counts.observations_added;
    total.points_merged += counts.points_merged;
  };

  std::vector<MapPointId> own;
  AppendPoints(map.keyframe(keyframe), own);
  for (const KeyFrameId target : targets) fuse(own, target);

  std::vector<MapPointId> others;
  for (const KeyFrameId target : targets) AppendPoints(map.keyframe(target), others);
  std::sort(others.begin(), others.end());
  others.erase(std::unique(others.begin(), others.end()), others.end());
  fuse(others, keyframe);

  for (const MapPointId id : map.keyframe(keyframe).map_points) {
    if (id.valid()) map.UpdateAppearance(id);
  }
  return total;
}

}  // namespace lift_slam
