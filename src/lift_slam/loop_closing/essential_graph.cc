#include "lift_slam/loop_closing/essential_graph.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <set>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// Collects each pair of keyframes once.
class EdgeCollector {
 public:
  EdgeCollector(const Map& map, EssentialGraph& graph) : map_(map), graph_(graph) {}

  void Add(KeyFrameId a, KeyFrameId b) {
    if (a == b || !pairs_.insert({std::min(a, b), std::max(a, b)}).second) return;
    const Rigid3d b_from_a =
        map_.keyframe(b).cam_from_world * Inverse(map_.keyframe(a).cam_from_world);
    graph_.graph.edges.push_back({graph_.IndexOf(a), graph_.IndexOf(b),
                                  Sim3d(1.0, b_from_a.rotation, b_from_a.translation), 1.0});
  }

 private:
  const Map& map_;
  EssentialGraph& graph_;
  std::set<std::pair<KeyFrameId, KeyFrameId>> pairs_;
};

// A share of a similarity: turns, scales and shifts about its fixed point. For one that is nearly
// a translation, whose fixed point is far away or nowhere, the same with a share of each part.
class SimilarityShare {
 public:
  explicit SimilarityShare(const Sim3d& whole) : whole_(whole) {
    const Eigen::Matrix3d system =
        Eigen::Matrix3d::Identity() - whole.scale * whole.rotation.toRotationMatrix();
    const Eigen::FullPivLU<Eigen::Matrix3d> factors(system);
    if (factors.rcond() < kMinCondition) return;
    fixed_point_ = factors.solve(whole.translation);
    has_fixed_point_ = fixed_point_.allFinite();
  }

  Sim3d Of(double share) const {
    const Eigen::Quaterniond rotation =
        Eigen::Quaterniond::Identity().slerp(share, whole_.rotation);
    const double scale = std::pow(whole_.scale, share);
    if (!has_fixed_point_) return {scale, rotation, share * whole_.translation};
    return {scale, rotation, fixed_point_ - scale * (rotation * fixed_point_)};
  }

 private:
  static constexpr double kMinCondition = 1e-6;
  Sim3d whole_;
  Eigen::Vector3d fixed_point_ = Eigen::Vector3d::Zero();
  bool has_fixed_point_ = false;
};

}  // namespace

int EssentialGraph::IndexOf(KeyFrameId keyframe) const {
  const auto found = std::lower_bound(keyframes.begin(), keyframes.end(), keyframe);
  LIFT_SLAM_CHECK(found != keyframes.end() && *found == keyframe, "keyframe {} is not in the graph",
                  keyframe.value);
  return static_cast<int>(found - keyframes.begin());
}

EssentialGraph BuildEssentialGraph(const Map& map, const SpanningTree& tree,
                                   const std::vector<LoopEdge>& loops, int min_shared_points,
                                   int max_neighbors) {
  EssentialGraph essential;
  essential.keyframes = map.KeyFrameIds();
  for (const KeyFrameId id : essential.keyframes) {
    const Rigid3d& pose = map.keyframe(id).cam_from_world;
    essential.graph.cams_from_world.emplace_back(1.0, pose.rotation, pose.translation);
    essential.graph.is_fixed.push_back(essential.graph.is_fixed.empty() ? 1 : 0);
  }
  EdgeCollector collector(map, essential);
  for (const SpanningTree::Edge& edge : tree.Edges()) collector.Add(edge.parent, edge.child);
  for (const LoopEdge& loop : loops) {
    const auto a = map.ResolveReference(loop.query), b = map.ResolveReference(loop.candidate);
    if (a && b) collector.Add(a->keyframe, b->keyframe);
  }
  for (const KeyFrameId id : essential.keyframes) {
    for (const auto& neighbor :
         map.covisibility().Neighbors(id, min_shared_points, max_neighbors)) {
      collector.Add(id, neighbor.keyframe);
    }
  }
  return essential;
}

void SpreadCorrection(const Sim3d& new_world_from_old_world, KeyFrameId first, KeyFrameId last,
                      EssentialGraph& graph) {
  const SimilarityShare correction(new_world_from_old_world);
  const double length = std::max(1, last.value - first.value);
  for (std::size_t i = 0; i < graph.keyframes.size(); ++i) {
    if (graph.graph.is_fixed[i]) continue;
    const double share = std::clamp((graph.keyframes[i].value - first.value) / length, 0.0, 1.0);
    Sim3d& pose = graph.graph.cams_from_world[i];
    pose = pose * Inverse(correction.Of(share));
  }
}

}  // namespace lift_slam
