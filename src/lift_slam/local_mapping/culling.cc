#include "lift_slam/local_mapping/culling.h"

namespace lift_slam {
namespace {

constexpr int kMinObservers = 3;
constexpr int kTestKeyFrames = 3;  // a point has passed after so many keyframes

bool IsRedundantIn(const Map& map, const KeyFrame& keyframe, int feature, const MapPoint& point) {
  if (point.num_observations() <= kMinObservers) return false;
  const int level = keyframe.features->level(feature);
  int others = 0;
  for (const auto& observation : point.observations) {
    if (observation.keyframe == keyframe.id) continue;
    const KeyFrame& other = map.keyframe(observation.keyframe);
    if (other.features->level(observation.feature) <= level + 1) ++others;
    if (others >= kMinObservers) return true;
  }
  return false;
}

bool IsRedundant(const Map& map, const KeyFrame& keyframe, double redundant_share) {
  int points = 0, redundant = 0;
  for (int i = 0; i < keyframe.features->size(); ++i) {
    const MapPoint* point = map.FindPoint(keyframe.map_points[static_cast<std::size_t>(i)]);
    if (point == nullptr) continue;
    ++points;
    if (IsRedundantIn(map, keyframe, i, *point)) ++redundant;
  }
  return redundant > redundant_share * points;
}

}  // namespace

CulledPoints CullRecentPoints(const LocalMapperOptions& options, int num_mapped, Map& map,
                              std::vector<RecentPoint>& recent) {
  CulledPoints culled;
  std::vector<RecentPoint> still_recent;
  for (const RecentPoint& made : recent) {
    const MapPoint* point = map.FindPoint(made.id);
    if (point == nullptr) continue;
    const int age = num_mapped - made.made_at;
    const bool is_rarely_found = point->num_found < options.min_found_ratio * point->num_visible;
    if (is_rarely_found || (age >= 2 && point->num_observations() < kMinObservers)) {
      map.ErasePoint(made.id);
      ++(is_rarely_found ? culled.rarely_found : culled.few_observers);
    } else if (age < kTestKeyFrames) {
      still_recent.push_back(made);
    }
  }
  recent = std::move(still_recent);
  return culled;
}

int CullKeyFrames(KeyFrameId newest, const LocalMapperOptions& options, Map& map) {
  int erased = 0;
  for (const auto& neighbor :
       map.covisibility().Neighbors(newest, options.bundle_min_shared_points)) {
    if (neighbor.keyframe.value == 0) continue;  // fixes the map's frame
    if (IsRedundant(map, map.keyframe(neighbor.keyframe), options.redundant_share)) {
      map.EraseKeyFrame(neighbor.keyframe);
      ++erased;
    }
  }
  return erased;
}

}  // namespace lift_slam
