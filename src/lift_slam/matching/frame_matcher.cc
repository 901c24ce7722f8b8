#include "lift_slam/matching/frame_matcher.h"

#include <algorithm>
#include <cstdlib>

#include "lift_slam/matching/nearest_two.h"
#include "lift_slam/matching/point_projection.h"
#include "lift_slam/matching/rotation_consistency.h"

namespace lift_slam {
namespace {

constexpr float kLocalRatio = 0.8F;
constexpr float kKeyFrameRatio = 0.75F;
// A point seen nearly from its usual direction is found nearer to its projection.
constexpr double kFrontalCosine = 0.998;
constexpr float kFrontalRadiusPx = 2.5F, kObliqueRadiusPx = 4.0F;

std::size_t Index(int i) { return static_cast<std::size_t>(i); }

int RemoveRotationOutliers(const RotationConsistency& rotation, Frame& frame) {
  const std::vector<int> outliers = rotation.Outliers();
  for (const int feature : outliers) frame.map_points[Index(feature)] = MapPointId();
  return static_cast<int>(outliers.size());
}

// Nearest two free features in the window of about this level.
NearestTwo SearchWindow(const Frame& frame, DescriptorView descriptor, const Eigen::Vector2d& pixel,
                        float radius_px, int level, int level_tolerance) {
  const FrameFeatures& features = *frame.features;
  NearestTwo nearest;
  features.ForEachInSquare(
      static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), radius_px, [&](int i) {
        if (std::abs(features.level(i) - level) > level_tolerance) return;
        if (frame.map_points[Index(i)].valid()) return;
        nearest.Offer(
            i, DescriptorDistance(features.descriptor_kind(), descriptor, features.descriptor(i)));
      });
  return nearest;
}

bool AlreadyMatched(const std::vector<MapPointId>& sorted, MapPointId id) {
  return std::binary_search(sorted.begin(), sorted.end(), id);
}

std::vector<MapPointId> SortedMatches(const Frame& frame) {
  std::vector<MapPointId> ids;
  for (const MapPointId id : frame.map_points) {
    if (id.valid()) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

}  // namespace

int MatchFromLastFrame(const Map& map, const Frame& last, float radius_px, float max_distance,
                       Frame& frame) {
  const ViewModel& view = map.view();
  RotationConsistency rotation;
  int matches = 0;
  for (int i = 0; i < last.features->size(); ++i) {
    const MapPoint* point = map.FindPoint(last.map_points[Index(i)]);
    if (point == nullptr) continue;
    const Eigen::Vector3d in_cam = frame.cam_from_world * point->position;
    if (in_cam.z() <= 0.0) continue;
    const Eigen::Vector2d pixel = view.pinhole.Project(in_cam);
    if (!view.Covers(pixel)) continue;
    const int level = last.features->level(i);
    const NearestTwo nearest =
        SearchWindow(frame, point->descriptor, pixel, radius_px * view.scale[Index(level)], level,
                     view.level_tolerance);
    if (nearest.best < 0 || nearest.best_distance > max_distance) continue;
    frame.map_points[Index(nearest.best)] = point->id;
    rotation.Add(last.features->keypoint(i).angle_rad,
                 frame.features->keypoint(nearest.best).angle_rad, nearest.best);
    ++matches;
  }
  return matches - RemoveRotationOutliers(rotation, frame);
}

LocalMatchResult MatchLocalPoints(const Map& map, std::span<const MapPointId> points,
                                  float radius_factor, float max_distance, Frame& frame) {
  const ViewModel& view = map.view();
  const std::vector<MapPointId> matched = SortedMatches(frame);
  LocalMatchResult result;
  result.visible = matched;
  for (const MapPointId id : points) {
    if (AlreadyMatched(matched, id)) continue;
    const MapPoint* point = map.FindPoint(id);
    if (point == nullptr) continue;
    const auto projection = ProjectPoint(view, *point, frame.cam_from_world);
    if (!projection) continue;
    result.visible.push_back(id);
    const float radius =
        (projection->viewing_cosine > kFrontalCosine ? kFrontalRadiusPx : kObliqueRadiusPx) *
        radius_factor * view.scale[Index(projection->level)];
    const NearestTwo nearest = SearchWindow(frame, point->descriptor, projection->pixel, radius,
                                            projection->level, view.level_tolerance);
    if (nearest.best < 0 || nearest.best_distance > max_distance) continue;
    const bool same_level = nearest.second >= 0 && frame.features->level(nearest.best) ==
                                                       frame.features->level(nearest.second);
    if (same_level && !nearest.IsDistinctive(kLocalRatio)) continue;
    frame.map_points[Index(nearest.best)] = id;
    ++result.num_matches;
  }
  return result;
}

int MatchFromKeyFrame(const Map& map, const KeyFrame& keyframe, float max_distance, Frame& frame) {
  const FrameFeatures& features = *frame.features;
  RotationConsistency rotation;
  int matches = 0;
  for (int i = 0; i < keyframe.features->size(); ++i) {
    const MapPoint* point = map.FindPoint(keyframe.map_points[Index(i)]);
    if (point == nullptr) continue;
    const DescriptorView descriptor = keyframe.features->descriptor(i);
    NearestTwo nearest;
    for (int j = 0; j < features.size(); ++j) {
      if (frame.map_points[Index(j)].valid()) continue;
      nearest.Offer(
          j, DescriptorDistance(features.descriptor_kind(), descriptor, features.descriptor(j)));
    }
    if (nearest.best < 0 || nearest.best_distance > max_distance ||
        !nearest.IsDistinctive(kKeyFrameRatio)) {
      continue;
    }
    frame.map_points[Index(nearest.best)] = point->id;
    rotation.Add(keyframe.features->keypoint(i).angle_rad,
                 features.keypoint(nearest.best).angle_rad, nearest.best);
    ++matches;
  }
  return matches - RemoveRotationOutliers(rotation, frame);
}

}  // namespace lift_slam
