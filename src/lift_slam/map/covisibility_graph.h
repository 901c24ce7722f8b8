#pragma once

#include <map>
#include <vector>

#include "lift_slam/map/ids.h"

namespace lift_slam {

// Undirected graph of keyframes; the weight of an edge is the number of map points both see
// (ORB-SLAM sec. III-D; paper sec. 3.2 "Mapping"). Kept exact as observations come and go.
class CovisibilityGraph {
 public:
  struct Neighbor {
    KeyFrameId keyframe;
    int shared_points = 0;
  };

  // Adds `change` shared points to the edge a-b; a != b.
  void AddShared(KeyFrameId a, KeyFrameId b, int change);
  void Erase(KeyFrameId keyframe);
  // Takes over another graph's edges, with ids moved up by `offset`.
  void Absorb(const CovisibilityGraph& other, int offset);

  int SharedPoints(KeyFrameId a, KeyFrameId b) const;
  // Neighbours that share at least `min_shared` points, most shared first, ties by id; at most
  // `max_count` of them (0: all).
  std::vector<Neighbor> Neighbors(KeyFrameId keyframe, int min_shared, int max_count = 0) const;

 private:
  std::map<KeyFrameId, std::map<KeyFrameId, int>> edges_;
};

}  // namespace lift_slam
