#pragma once

#include <map>
#include <optional>
#include <vector>

#include "lift_slam/map/map.h"

namespace lift_slam {

// Tree over a map's keyframes (ORB-SLAM sec. III-D): the parent of a keyframe is the one that
// shared most points with it when it came. With few edges it connects them all.
class SpanningTree {
 public:
  struct Edge {
    KeyFrameId parent, child;
  };

  // The keyframe's parent is its strongest covisible one in the tree; none: the root of a tree of
  // its own, as the first keyframe is.
  void Add(KeyFrameId keyframe, const Map& map);
  // Takes out keyframes that are no longer in the map: their children go to the erased one's
  // parent, or, without one, to the oldest of themselves.
  void ForgetErased(const Map& map);
  // Takes over the other tree, whose ids have been moved up by `offset`.
  void Absorb(const SpanningTree& other, int offset);

  bool Has(KeyFrameId keyframe) const { return parents_.count(keyframe) > 0; }
  std::optional<KeyFrameId> Parent(KeyFrameId keyframe) const;
  // By child, ascending.
  std::vector<Edge> Edges() const;

 private:
  void Erase(KeyFrameId keyframe);

  std::map<KeyFrameId, KeyFrameId> parents_;  // invalid id: a root
};

}  // namespace lift_slam
