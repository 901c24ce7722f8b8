#include "lift_slam/tracking/local_map.h"

#include <algorithm>
#include <map>

namespace lift_slam {
namespace {

constexpr int kNeighborsOfEach = 10;

std::vector<CovisibilityGraph::Neighbor> KeyFramesSharingPoints(const Map& map,
                                                                const Frame& frame) {
  std::map<KeyFrameId, int> shared;
  for (const MapPointId id : frame.map_points) {
    const MapPoint* point = map.FindPoint(id);
    if (point == nullptr) continue;
    for (const auto& observation : point->observations) ++shared[observation.keyframe];
  }
  std::vector<CovisibilityGraph::Neighbor> sorted;
  for (const auto& [keyframe, count] : shared) sorted.push_back({keyframe, count});
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.shared_points > b.shared_points; });
  return sorted;
}

// Appends the keyframe unless it is there already or the list is full.
void Append(KeyFrameId keyframe, std::size_t max_size, std::vector<KeyFrameId>& list) {
  if (list.size() < max_size && std::find(list.begin(), list.end(), keyframe) == list.end()) {
    list.push_back(keyframe);
  }
}

}  // namespace

LocalMap CollectLocalMap(const Map& map, const Frame& frame, int max_keyframes) {
  const auto sharing = KeyFramesSharingPoints(map, frame);
  LocalMap local;
  if (sharing.empty()) return local;
  local.reference = sharing.front().keyframe;
  const auto max_size = static_cast<std::size_t>(max_keyframes);
  for (const auto& neighbor : sharing) Append(neighbor.keyframe, max_size, local.keyframes);
  for (std::size_t i = 0; i < sharing.size() && local.keyframes.size() < max_size; ++i) {
    for (const auto& neighbor :
         map.covisibility().Neighbors(sharing[i].keyframe, 15, kNeighborsOfEach)) {
      Append(neighbor.keyframe, max_size, local.keyframes);
    }
  }
  local.points = map.PointsSeenBy(local.keyframes);
  return local;
}

}  // namespace lift_slam
