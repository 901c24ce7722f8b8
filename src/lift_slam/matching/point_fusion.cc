#include "lift_slam/matching/point_fusion.h"

#include <cstdlib>

#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/matching/nearest_two.h"
#include "lift_slam/matching/observation_alignment.h"
#include "lift_slam/matching/point_projection.h"

namespace lift_slam {
namespace {

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

int FindFeature(const Map& map, const KeyFrame& keyframe, const MapPoint& point,
                const PointProjection& projection, float radius_px, float max_distance) {
  const ViewModel& view = map.view();
  const FrameFeatures& features = *keyframe.features;
  NearestTwo nearest;
  features.ForEachInSquare(
      static_cast<float>(projection.pixel.x()), static_cast<float>(projection.pixel.y()),
      radius_px * view.scale[Index(projection.level)], [&](int i) {
        const int level = features.level(i);
        if (std::abs(level - projection.level) > view.level_tolerance) return;
        const double squared_error = (features.pixel(i) - projection.pixel).squaredNorm();
        // A feature farther from the projection is another point.
        if (squared_error * view.inverse_variance[Index(level)] > kChiSquare95With2Dof) return;
        nearest.Offer(i, DescriptorDistance(features.descriptor_kind(), point.descriptor,
                                            features.descriptor(i)));
      });
  return nearest.best_distance <= max_distance ? nearest.best : -1;
}

// The observations that come along are aligned to the patch of the point that stays.
void MergeAndAlign(MapPointId from, MapPointId into, Map& map) {
  const std::vector<MapPoint::Observation> moved = map.point(from).observations;
  map.MergePoints(from, into);
  for (const auto& observation : moved) {
    if (map.point(into).FeatureIn(observation.keyframe) == observation.feature) {
      AlignObservation(into, observation.keyframe, map);
    }
  }
}

}  // namespace

FusionCounts FusePoints(std::span<const MapPointId> points, KeyFrameId keyframe_id, float radius_px,
                        float max_distance, Map& map) {
  FusionCounts counts;
  for (const MapPointId id : points) {
    const MapPoint* point = map.FindPoint(id);
    const KeyFrame& keyframe = map.keyframe(keyframe_id);
    if (point == nullptr || point->FeatureIn(keyframe_id) >= 0) continue;
    const auto projection = ProjectPoint(map.view(), *point, keyframe.cam_from_world);
    if (!projection) continue;
    const int feature = FindFeature(map, keyframe, *point, *projection, radius_px, max_distance);
    if (feature < 0) continue;
    const MapPointId present = keyframe.map_points[Index(feature)];
    if (!present.valid()) {
      map.AddObservation(id, keyframe_id, feature);
      AlignObservation(id, keyframe_id, map);
      ++counts.observations_added;
    } else {
      const bool keep_present = map.point(present).num_observations() > point->num_observations();
      MergeAndAlign(keep_present ? id : present, keep_present ? present : id, map);
      ++counts.points_merged;
    }
  }
  return counts;
}

}  // namespace lift_slam
