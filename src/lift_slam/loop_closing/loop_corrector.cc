#include "lift_slam/loop_closing/loop_corrector.h"

#include "lift_slam/loop_closing/place_verifier.h"
#include "lift_slam/matching/observation_alignment.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

Sim3d AsSimilarity(const Rigid3d& pose) { return {1.0, pose.rotation, pose.translation}; }

// Ties the neighbourhoods of both sides together, not only the two keyframes: else most of the
// correction would fall on the few edges next to these, as the current next to the ends of a grid.
void AddLoopEdges(const PlaceMatch& match, const LoopEdge& loop,
                  const LoopCorrectionOptions& options, const Map& map, EssentialGraph& essential) {
  const Rigid3d& query_pose = map.keyframe(loop.query).cam_from_world;
  const auto add = [&](KeyFrameId query, KeyFrameId candidate) {
    const Sim3d query_from_world =
        AsSimilarity(map.keyframe(query).cam_from_world * Inverse(query_pose)) *
        match.query_from_candidate_world;
    essential.graph.edges.push_back(
        {essential.IndexOf(candidate), essential.IndexOf(query),
         query_from_world * Inverse(AsSimilarity(map.keyframe(candidate).cam_from_world)),
         options.loop_edge_weight});
  };
  const auto neighbors = [&](KeyFrameId id) {
    return WithNeighbors(map, id, options.min_neighbor_shared_points, options.max_loop_edges);
  };
  for (const KeyFrameId candidate : neighbors(loop.candidate)) add(loop.query, candidate);
  for (const KeyFrameId query : neighbors(loop.query)) {
    if (query != loop.query) add(query, loop.candidate);
  }
}

// Poses and points as the solved graph has them. Each point goes with its oldest observer.
void MoveMap(const EssentialGraph& solved, std::vector<double>& scale_of_keyframe, Map& map) {
  for (const MapPointId id : map.PointIds()) {
    MapPoint& point = map.point(id);
    const KeyFrameId observer = point.observations.front().keyframe;
    point.position = CorrectedPoint(
        point.position, map.keyframe(observer).cam_from_world,
        solved.graph.cams_from_world[static_cast<std::size_t>(solved.IndexOf(observer))]);
  }
  for (std::size_t i = 0; i < solved.keyframes.size(); ++i) {
    const Sim3d& pose = solved.graph.cams_from_world[i];
    map.SetPose(solved.keyframes[i], CorrectedPose(pose));
    scale_of_keyframe[solved.keyframes[i].index()] = 1.0 / pose.scale;
  }
  for (const MapPointId id : map.PointIds()) map.UpdateViewingRange(id);
}

// What was measured relative to an erased keyframe follows the one that stands for it.
void ScaleErased(const Map& map, std::vector<double>& scale_of_keyframe) {
  for (std::size_t i = 0; i < scale_of_keyframe.size(); ++i) {
    const auto reference = map.ResolveReference(KeyFrameId(static_cast<std::int32_t>(i)));
    if (reference) scale_of_keyframe[i] = scale_of_keyframe[reference->keyframe.index()];
  }
}

void FuseMatches(const PlaceMatch& match, KeyFrameId query, FusionCounts& counts, Map& map) {
  for (std::size_t i = 0; i < match.points.size(); ++i) {
    const MapPointId point = match.points[i];
    if (map.FindPoint(point) == nullptr) continue;
    const MapPointId present = map.keyframe(query).map_points[i];
    if (present == point || map.point(point).FeatureIn(query) >= 0) continue;
    if (present.valid()) {
      MergeAndAlignPoints(present, point, map);
      ++counts.points_merged;
    } else {
      map.AddObservation(point, query, static_cast<int>(i));
      AlignObservation(point, query, map);
      ++counts.observations_added;
    }
  }
}

}  // namespace

LoopCorrection CorrectLoop(const PlaceMatch& match, const LoopEdge& loop, const SpanningTree& tree,
                           const std::vector<LoopEdge>& loops, const LoopCorrectionOptions& options,
                           Map& map) {
  LoopCorrection correction;
  correction.scale_of_keyframe.assign(map.newest_keyframe().index() + 1, 1.0);
  const Timer graph_timer;
  EssentialGraph essential = BuildEssentialGraph(map, tree, loops, options.min_graph_shared_points,
                                                 options.max_graph_neighbors);
  AddLoopEdges(match, loop, options, map, essential);
  const Rigid3d& query_pose = map.keyframe(loop.query).cam_from_world;
  SpreadCorrection(Inverse(match.query_from_candidate_world) * AsSimilarity(query_pose),
                   loop.candidate, loop.query, essential);
  correction.graph = SolvePoseGraph(essential.graph, ScaleFit::kFree, options.graph);
  correction.graph_ms = graph_timer.ElapsedMs();
  if (!correction.graph.usable) return correction;

  const Timer fusion_timer;
  MoveMap(essential, correction.scale_of_keyframe, map);
  ScaleErased(map, correction.scale_of_keyframe);
  map.ScaleReferences(correction.scale_of_keyframe);
  correction.fused = FusePlaces(match, loop, options, map);
  correction.fusion_ms = fusion_timer.ElapsedMs();
  return correction;
}

FusionCounts FusePlaces(const PlaceMatch& match, const LoopEdge& loop,
                        const LoopCorrectionOptions& options, Map& map) {
  // Both sides as they are now: fusion makes them neighbours of each other.
  const std::vector<KeyFrameId> query_side =
      WithNeighbors(map, loop.query, options.min_neighbor_shared_points, options.max_neighbors);
  const std::vector<KeyFrameId> place_side =
      WithNeighbors(map, loop.candidate, options.min_neighbor_shared_points, options.max_neighbors);
  const std::vector<MapPointId> place_points = map.PointsSeenBy(place_side);
  FusionCounts counts;
  FuseMatches(match, loop.query, counts, map);
  for (const KeyFrameId id : query_side) {
    const FusionCounts fused =
        FusePoints(place_points, id, static_cast<float>(options.fusion_radius_px),
                   map.view().thresholds.fixed.low, map, FusionWinner::kGiven);
    counts.observations_added += fused.observations_added;
    counts.points_merged += fused.points_merged;
  }
  for (const MapPointId id : map.PointsSeenBy(query_side)) map.UpdateAppearance(id);
  return counts;
}

}  // namespace lift_slam
