#include "lift_slam/loop_closing/loop_closing_options.h"

namespace lift_slam {

void PlaceVerificationOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("window_keyframes", window_keyframes,
                "covisible keyframes whose points join the candidate's");
  visitor.Field("min_word_matches", min_word_matches, "map points that match by descriptors");
  visitor.Field("min_inliers", min_inliers, "matches that agree with the optimised similarity");
  visitor.Field("max_offset_ratio", max_offset_ratio,
                "distance between both cameras, over the median depth of the place's points");
  visitor.Field("min_projected", min_projected, "features that show a point of the place");
  visitor.Field("min_mutual_ratio", min_mutual_ratio,
                "share of the place's points that the query sees and of the query's that the place "
                "sees, each over the usual one there; geometric mean");
  visitor.Field("confirming_keyframes", confirming_keyframes,
                "covisible keyframes of the query that are asked whether they see the place");
  visitor.Field("min_confirming", min_confirming, "of these that must see it");
  visitor.Field("min_confirming_points", min_confirming_points, "points that each must see");
  visitor.Field("search_radius_factor", search_radius_factor,
                "search window, of that of local map tracking");
  visitor.Field("max_squared_error", max_squared_error,
                "squared error over variance of a point that is not seen where it should be");
  visitor.Group("ransac", ransac, "pose from the first matches");
  visitor.Field("min_scale_matches", min_scale_matches,
                "of these with map points on both sides, for the first scale");
  visitor.Field("min_scale_share", min_scale_share,
                "share of their ratios of depths that must agree on the scale");
  visitor.Group("sim3", sim3, "optimisation of the similarity");
}

void LoopCorrectionOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("min_graph_shared_points", min_graph_shared_points,
                "points a covisible pair shares to be an edge of the essential graph");
  visitor.Field("max_graph_neighbors", max_graph_neighbors,
                "covisible keyframes of each that are edges, most shared points first");
  visitor.Field("max_loop_edges", max_loop_edges,
                "neighbours of either side that the loop's edges hold together");
  visitor.Field("min_neighbor_shared_points", min_neighbor_shared_points,
                "points a keyframe shares with the query or the candidate to be fused");
  visitor.Field("max_neighbors", max_neighbors, "keyframes of either side that are fused");
  visitor.Field("fusion_radius_px", fusion_radius_px, "search window of fusion, full-size level");
  visitor.Field("loop_edge_weight", loop_edge_weight,
                "of the loop's edge in the essential graph; the others have 1");
  visitor.Group("graph", graph, "essential graph optimisation");
}

void LoopConfirmationOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("enabled", enabled, "believe a loop only when two keyframes say the same of it");
  visitor.Field("max_keyframes_between", max_keyframes_between,
                "keyframes between those two at most");
  visitor.Field("max_disagreement", max_disagreement,
                "difference of their positions over the way between them");
}

BundleOptions LoopBundleOptions::Defaults() {
  BundleOptions options;
  options.robust_iterations = 4;
  options.plain_iterations = 4;
  return options;
}

void LoopBundleOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("enabled", enabled, "adjust the whole map after a loop, beside tracking");
  visitor.Field("merge_after_keyframes", merge_after_keyframes,
                "made since the loop, until the result is waited for and merged");
  visitor.Group("bundle", bundle, "bundle adjustment");
}

void LoopClosingOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("enabled", enabled, "close loops, where there is a vocabulary for the features");
  visitor.Field("vocabulary", vocabulary, "file; empty: the one shipped for the features");
  visitor.Field("relocalisation", relocalisation, "of a lost camera, in all maps of the run");
  visitor.Field("merging", merging, "of maps that show the same place");
  visitor.Field("score", score, kBagScoreNames, "of two images' words; l2 is the paper's");
  visitor.Group("candidates", candidates, "which keyframes may show the same place");
  visitor.Field("min_shared_points", min_shared_points,
                "points that covisible keyframes share; they are no candidates");
  visitor.Field("min_keyframes_apart", min_keyframes_apart,
                "keyframes between a candidate and the query at least");
  visitor.Field("min_keyframes_after_loop", min_keyframes_after_loop,
                "keyframes before the next loop is looked for");
  visitor.Field("max_drift_ratio", max_drift_ratio,
                "displacement by a loop over the length of the way, at most");
  visitor.Field("max_verified", max_verified, "candidates verified at most, best first");
  visitor.Group("verification", verification, "whether a candidate is the same place");
  visitor.Group("confirmation", confirmation, "whether keyframes agree on a loop");
  visitor.Group("correction", correction, "of the map");
  visitor.Group("bundle", bundle, "bundle adjustment of the whole map after a loop");
}

}  // namespace lift_slam
