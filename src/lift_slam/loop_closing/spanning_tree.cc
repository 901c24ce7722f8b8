#include "lift_slam/loop_closing/spanning_tree.h"

#include "lift_slam/util/check.h"

namespace lift_slam {

void SpanningTree::Add(KeyFrameId keyframe, const Map& map) {
  LIFT_SLAM_CHECK(!Has(keyframe), "keyframe {} is in the tree already", keyframe.value);
  KeyFrameId parent;
  for (const auto& neighbor : map.covisibility().Neighbors(keyframe, 1)) {
    if (!Has(neighbor.keyframe)) continue;
    parent = neighbor.keyframe;
    break;
  }
  parents_[keyframe] = parent;
}

void SpanningTree::ForgetErased(const Map& map) {
  std::vector<KeyFrameId> erased;
  for (const auto& [child, parent] : parents_) {
    if (map.FindKeyFrame(child) == nullptr) erased.push_back(child);
  }
  for (const KeyFrameId keyframe : erased) Erase(keyframe);
}

void SpanningTree::Erase(KeyFrameId keyframe) {
  KeyFrameId heir = parents_.at(keyframe);
  parents_.erase(keyframe);
  for (auto& [child, parent] : parents_) {
    if (parent != keyframe) continue;
    parent = heir;
    if (!heir.valid()) heir = child;  // the oldest child becomes the root
  }
}

void SpanningTree::Absorb(const SpanningTree& other, int offset) {
  for (const auto& [child, parent] : other.parents_) {
    const KeyFrameId moved(child.value + offset);
    LIFT_SLAM_CHECK(!Has(moved), "keyframe {} is in the tree already", moved.value);
    parents_[moved] = parent.valid() ? KeyFrameId(parent.value + offset) : KeyFrameId();
  }
}

std::optional<KeyFrameId> SpanningTree::Parent(KeyFrameId keyframe) const {
  const auto found = parents_.find(keyframe);
  if (found == parents_.end() || !found->second.valid()) return std::nullopt;
  return found->second;
}

std::vector<SpanningTree::Edge> SpanningTree::Edges() const {
  std::vector<Edge> edges;
  for (const auto& [child, parent] : parents_) {
    if (parent.valid()) edges.push_back({parent, child});
  }
  return edges;
}

}  // namespace lift_slam
