#pragma once

#include <string>

#include "lift_slam/geometry/absolute_pose.h"
#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/optimization/bundle_adjustment.h"
#include "lift_slam/optimization/pose_graph.h"
#include "lift_slam/optimization/sim3_optimization.h"
#include "lift_slam/place_recognition/loop_candidates.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct PlaceVerificationOptions {
  int window_keyframes = 5;   // covisible keyframes whose points join the candidate's
  int min_word_matches = 20;  // fewer agree by chance
  int min_inliers = 20;       // of the optimised similarity
  // Between both cameras, over the median depth of the candidate's points: what is far off is
  // placed roughly, and comes nearer when it is the same way.
  double max_offset_ratio = 1.0;
  int min_projected = 70;  // features that show a point of the place; false ones reached 61
  // PlaceMatch::mutual_ratio: within 5 m of the place it is 0.7 to 1.2, seldom 0.62 (ORB and LIFT
  // on rendered drives); where the same walls and boards stand elsewhere up to 0.66.
  double min_mutual_ratio = 0.7;
  int confirming_keyframes = 5;       // covisible keyframes of the query that should see the place
  int min_confirming = 2;             // of these
  int min_confirming_points = 20;     // that each must see
  double search_radius_factor = 2.5;  // of the windows of local map tracking (2.5 to 4 px)
  // Of the query's map points; in sigmas, as for the similarity.
  double max_squared_error = kChiSquare99With2Dof;
  int min_scale_matches = 8;     // with map points on both sides, for the first scale
  double min_scale_share = 0.4;  // of their ratios of depths that must agree on it
  AbsolutePoseOptions ransac;
  Sim3OptimizationOptions sim3;

  void Visit(OptionVisitor& visitor);
};

struct LoopCorrectionOptions {
  int min_graph_shared_points = 100;  // of a covisible pair to be an edge of the essential graph
  int max_graph_neighbors = 10;       // of a keyframe, most shared points first
  int max_loop_edges = 10;  // neighbours of either side that the loop's edges hold together
  int min_neighbor_shared_points = 15;  // of a keyframe to be fused with the place
  int max_neighbors = 30;               // of either side, most shared points first
  double fusion_radius_px = 4.0;        // search window of fusion, on level 0
  // Of the loop's edge: a similarity verified by dozens of points is far better than what has added
  // up along the way.
  double loop_edge_weight = 100.0;
  PoseGraphOptions graph;

  void Visit(OptionVisitor& visitor);
};

struct LoopConfirmationOptions {
  bool enabled = true;
  int max_keyframes_between = 20;  // both keyframes that say the same
  double max_disagreement = 0.3;   // of their positions, over the way between them

  void Visit(OptionVisitor& visitor);
};

struct LoopBundleOptions {
  bool enabled = true;
  int merge_after_keyframes = 20;  // made since the loop; then its end is waited for
  BundleOptions bundle = Defaults();

  void Visit(OptionVisitor& visitor);
  static BundleOptions Defaults();
};

struct LoopClosingOptions {
  bool enabled = true;         // where there is a vocabulary for the features
  std::string vocabulary;      // file; empty: the one shipped for the features
  bool relocalisation = true;  // of a lost camera, in all maps of the run
  bool merging = true;         // of maps that show the same place
  // The paper's is L2, which finds fewer places, most of all with LIFT (docs/place_recognition.md).
  BagScore score = BagScore::kL1;
  CandidateSelectionOptions candidates;
  int min_shared_points = 15;  // of covisible keyframes, which are no candidates
  // A candidate is this many keyframes older at least than the query.
  int min_keyframes_apart = 20;
  int min_keyframes_after_loop = 10;  // before the next loop is looked for (as ORB-SLAM)
  int max_verified = 5;               // candidates, best first
  // Displacement of the query over the length of the way since the candidate: what is farther off
  // did not get there by drift. A wrong place that looks the same is as far away as any other.
  double max_drift_ratio = 0.3;
  PlaceVerificationOptions verification;
  LoopConfirmationOptions confirmation;
  LoopCorrectionOptions correction;
  LoopBundleOptions bundle;

  void Visit(OptionVisitor& visitor);
};

}  // namespace lift_slam
