#pragma once

#include <vector>

#include "lift_slam/loop_closing/spanning_tree.h"
#include "lift_slam/map/map.h"
#include "lift_slam/optimization/pose_graph.h"

namespace lift_slam {

// Two keyframes found to show one place.
struct LoopEdge {
  KeyFrameId query, candidate;
};

// A map's keyframes joined by the spanning tree, earlier loops and strong covisibility (ORB-SLAM
// sec. III-D): the edges are the present relative poses, with scale 1.
struct EssentialGraph {
  std::vector<KeyFrameId> keyframes;  // by index of the graph, ascending
  PoseGraph graph;                    // the oldest keyframe is fixed

  // The keyframe must be in the graph.
  int IndexOf(KeyFrameId keyframe) const;
};

// Covisible pairs are edges from `min_shared_points` on, at most `max_neighbors` from each
// keyframe. Keyframes of loop edges that are gone are replaced by those that stand for them.
EssentialGraph BuildEssentialGraph(const Map& map, const SpanningTree& tree,
                                   const std::vector<LoopEdge>& loops, int min_shared_points,
                                   int max_neighbors);

// Where the keyframes are when the correction at the end of a loop, new_world_from_old_world, is
// spread evenly over the keyframes from `first` to `last` (whose ids say how far): none before,
// all of it after. A first guess, for the graph's cameras.
void SpreadCorrection(const Sim3d& new_world_from_old_world, KeyFrameId first, KeyFrameId last,
                      EssentialGraph& graph);

}  // namespace lift_slam
