#include "lift_slam/local_mapping/local_mapper.h"

#include <algorithm>
#include <map>

#include "lift_slam/local_mapping/culling.h"
#include "lift_slam/local_mapping/fusion.h"
#include "lift_slam/local_mapping/point_creation.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

// Keyframes outside `free` that see most of its points, most first.
std::vector<KeyFrameId> StrongestObservers(const std::vector<KeyFrameId>& free, int max_count,
                                           const Map& map) {
  std::map<KeyFrameId, int> shared;
  for (const KeyFrameId id : free) {
    for (const MapPointId point : map.keyframe(id).map_points) {
      if (!point.valid()) continue;
      for (const auto& observation : map.point(point).observations) ++shared[observation.keyframe];
    }
  }
  for (const KeyFrameId id : free) shared.erase(id);
  std::vector<CovisibilityGraph::Neighbor> sorted;
  for (const auto& [id, count] : shared) sorted.push_back({id, count});
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.shared_points > b.shared_points; });
  std::vector<KeyFrameId> observers;
  for (const auto& observer : sorted) {
    if (static_cast<int>(observers.size()) == max_count) break;
    observers.push_back(observer.keyframe);
  }
  return observers;
}

}  // namespace

MappingReport LocalMapper::Process(KeyFrameId keyframe, float max_distance, Map& map) {
  MappingReport report;
  const Timer create_timer;
  for (const MapPointId id : map.keyframe(keyframe).map_points) {
    if (id.valid()) map.UpdateAppearance(id);
  }
  report.points_culled = CullRecentPoints(options_, ++num_mapped_, map, recent_points_);
  const std::vector<MapPointId> created = CreatePoints(keyframe, options_, max_distance, map);
  for (const MapPointId id : created) recent_points_.push_back({id, num_mapped_});
  report.points_created = static_cast<int>(created.size());
  report.create_ms = create_timer.ElapsedMs();

  const Timer fuse_timer;
  const FusionCounts fused = FuseWithNeighbors(keyframe, options_, max_distance, map);
  report.points_fused = fused.points_merged;
  report.fuse_ms = fuse_timer.ElapsedMs();

  if (map.num_keyframes() > 2) {
    const Timer bundle_timer;
    report.bundle = AdjustLocalBundle(keyframe, map);
    report.bundle_ms = bundle_timer.ElapsedMs();
    const Timer cull_timer;
    report.keyframes_culled = CullKeyFrames(keyframe, options_, map);
    report.cull_ms = cull_timer.ElapsedMs();
  }
  return report;
}

void LocalMapper::Absorb(const LocalMapper& other, int offset) {
  for (const RecentPoint& point : other.recent_points_) {
    const int age = other.num_mapped_ - point.made_at;
    recent_points_.push_back({MapPointId(point.id.value + offset), num_mapped_ - age});
  }
}

MapBundleReport LocalMapper::AdjustLocalBundle(KeyFrameId keyframe, Map& map) const {
  std::vector<KeyFrameId> free = {keyframe};
  for (const auto& neighbor : map.covisibility().Neighbors(
           keyframe, options_.bundle_min_shared_points, options_.bundle_free_keyframes - 1)) {
    free.push_back(neighbor.keyframe);
  }
  std::vector<KeyFrameId> fixed = StrongestObservers(free, options_.bundle_fixed_keyframes, map);
  if (fixed.empty() && std::find(free.begin(), free.end(), KeyFrameId(0)) == free.end()) {
    // Nothing would hold the frame and scale: fix the oldest ones.
    std::sort(free.begin(), free.end());
    fixed.assign(free.begin(), free.begin() + 1);
    free.erase(free.begin());
  }
  return AdjustBundle(free, fixed, bundle_options_, map);
}

}  // namespace lift_slam
