#pragma once

#include <vector>

#include "lift_slam/loop_closing/essential_graph.h"
#include "lift_slam/loop_closing/loop_closing_options.h"
#include "lift_slam/loop_closing/place_match.h"
#include "lift_slam/map/map.h"
#include "lift_slam/matching/point_fusion.h"

namespace lift_slam {

// What a correction did to a map.
struct LoopCorrection {
  PoseGraphReport graph;  // not usable: the map is as it was
  FusionCounts fused;
  // By keyframe id (also of erased ones): factor of all lengths in the keyframe's camera frame,
  // for whatever is kept relative to it. 1 where nothing changed.
  std::vector<double> scale_of_keyframe;
  double graph_ms = 0.0, fusion_ms = 0.0;
};

// Closes a loop (ORB-SLAM sec. VII-C, D): optimises the essential graph with the loop's edge added,
// moves all keyframes and points accordingly, then fuses the points of both sides. `loops` are
// those closed before.
LoopCorrection CorrectLoop(const PlaceMatch& match, const LoopEdge& loop, const SpanningTree& tree,
                           const std::vector<LoopEdge>& loops, const LoopCorrectionOptions& options,
                           Map& map);

// Makes one of the points that the query and its neighbours share with the candidate's: the older
// points stay. Poses must agree already. `match.points` are those of the query's features.
FusionCounts FusePlaces(const PlaceMatch& match, const LoopEdge& loop,
                        const LoopCorrectionOptions& options, Map& map);

}  // namespace lift_slam
