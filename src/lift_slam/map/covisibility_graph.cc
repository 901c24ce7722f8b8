#include "lift_slam/map/covisibility_graph.h"

#include <algorithm>

#include "lift_slam/util/check.h"

namespace lift_slam {

void CovisibilityGraph::AddShared(KeyFrameId a, KeyFrameId b, int change) {
  LIFT_SLAM_CHECK(a != b, "keyframe {} with itself", a.value);
  const auto add = [&](KeyFrameId from, KeyFrameId to) {
    auto& neighbors = edges_[from];
    int& weight = neighbors[to];
    weight += change;
    LIFT_SLAM_CHECK(weight >= 0, "edge {}-{} has weight {}", from.value, to.value, weight);
    if (weight == 0) neighbors.erase(to);
  };
  add(a, b);
  add(b, a);
}

void CovisibilityGraph::Erase(KeyFrameId keyframe) {
  const auto found = edges_.find(keyframe);
  if (found == edges_.end()) return;
  for (const auto& [neighbor, weight] : found->second) edges_[neighbor].erase(keyframe);
  edges_.erase(found);
}

void CovisibilityGraph::Absorb(const CovisibilityGraph& other, int offset) {
  for (const auto& [keyframe, neighbors] : other.edges_) {
    auto& moved = edges_[KeyFrameId(keyframe.value + offset)];
    for (const auto& [neighbor, shared] : neighbors) {
      moved[KeyFrameId(neighbor.value + offset)] = shared;
    }
  }
}

int CovisibilityGraph::SharedPoints(KeyFrameId a, KeyFrameId b) const {
  const auto from = edges_.find(a);
  if (from == edges_.end()) return 0;
  const auto to = from->second.find(b);
  return to == from->second.end() ? 0 : to->second;
}

std::vector<CovisibilityGraph::Neighbor> CovisibilityGraph::Neighbors(KeyFrameId keyframe,
                                                                      int min_shared,
                                                                      int max_count) const {
  std::vector<Neighbor> neighbors;
  const auto found = edges_.find(keyframe);
  if (found == edges_.end()) return neighbors;
  for (const auto& [id, shared] : found->second) {
    if (shared >= min_shared) neighbors.push_back({id, shared});
  }
  std::stable_sort(neighbors.begin(), neighbors.end(), [](const Neighbor& a, const Neighbor& b) {
    return a.shared_points > b.shared_points;
  });
  if (max_count > 0 && neighbors.size() > static_cast<std::size_t>(max_count)) {
    neighbors.resize(static_cast<std::size_t>(max_count));
  }
  return neighbors;
}

}  // namespace lift_slam
