#include "lift_slam/loop_closing/loop_bundle.h"

#include "lift_slam/geometry/sim3.h"
#include "lift_slam/optimization/map_bundle_problem.h"
#include "lift_slam/util/median.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

struct Solved {
  BundleProblem problem;
  BundleReport report;
  double solve_ms = 0.0;
};

Solved Solve(BundleProblem problem, const BundleOptions& options) {
  const Timer timer;
  Solved solved{std::move(problem), {}, 0.0};
  solved.report = SolveBundle(solved.problem, options);
  solved.solve_ms = timer.ElapsedMs();
  return solved;
}

double DepthOf(const BundleProblem& problem, const BundleObservation& observation) {
  return (problem.cams_from_world[static_cast<std::size_t>(observation.camera)] *
          problem.points[static_cast<std::size_t>(observation.point)])
      .z();
}

// By camera: the median over its points of the depth after over the depth before; 1 without any.
std::vector<double> ScalesOf(const BundleProblem& before, const Solved& solved) {
  std::vector<std::vector<double>> ratios(before.cams_from_world.size());
  for (std::size_t i = 0; i < before.observations.size(); ++i) {
    const BundleObservation& observation = before.observations[i];
    const double old_depth = DepthOf(before, observation);
    const double depth = DepthOf(solved.problem, observation);
    if (!solved.report.is_inlier[i] || old_depth <= 0.0 || depth <= 0.0) continue;
    ratios[static_cast<std::size_t>(observation.camera)].push_back(depth / old_depth);
  }
  std::vector<double> scales;
  for (std::vector<double>& values : ratios) {
    scales.push_back(values.empty() ? 1.0 : Median(std::move(values)));
  }
  return scales;
}

// Moves what is around a camera as the adjustment has moved the camera.
Sim3d NewFromOldWorld(const Rigid3d& before, const Rigid3d& after, double scale) {
  const Rigid3d back = Inverse(after);
  return Sim3d(1.0, back.rotation, back.translation) *
         Sim3d(scale, before.rotation, scale * before.translation);
}

}  // namespace

struct LoopBundle::Running {
  BundleIndex index;
  BundleProblem before;
  std::future<Solved> result;
  int keyframes_left = 0;
};

namespace {

// Takes one solved problem over into the map.
class Merge {
 public:
  Merge(const BundleIndex& index, const BundleProblem& before, const Solved& solved,
        const SpanningTree& tree, Map& map)
      : index_(index), before_(before), solved_(solved), tree_(tree), map_(map) {}

  std::vector<double> Run() {
    FindMotions();
    MovePoints();
    for (const KeyFrameId id : map_.KeyFrameIds()) {
      const Sim3d& motion = motion_[id.index()];
      map_.SetPose(id, Inverse(TransformWorld(Inverse(map_.keyframe(id).cam_from_world), motion)));
    }
    std::vector<double> scales(motion_.size(), 1.0);
    for (std::size_t i = 0; i < scales.size(); ++i) {
      const auto reference = map_.ResolveReference(KeyFrameId(static_cast<std::int32_t>(i)));
      if (reference) scales[i] = motion_[reference->keyframe.index()].scale;
    }
    map_.ScaleReferences(scales);
    return scales;
  }

 private:
  // By keyframe id, for all in the map: its own, or that of the nearest ancestor which has one.
  void FindMotions() {
    const std::vector<double> scales = ScalesOf(before_, solved_);
    motion_.resize(map_.num_keyframe_ids());
    for (const KeyFrameId id : map_.KeyFrameIds()) {
      KeyFrameId known = id;
      while (known.valid() && index_.CameraOf(known) < 0) {
        known = tree_.Parent(known).value_or(KeyFrameId());
      }
      if (!known.valid()) continue;
      const auto camera = static_cast<std::size_t>(index_.CameraOf(known));
      motion_[id.index()] = NewFromOldWorld(
          before_.cams_from_world[camera], solved_.problem.cams_from_world[camera], scales[camera]);
    }
  }

  // Points that nothing has moved since then take their new place, others go with their oldest
  // observer.
  void MovePoints() {
    std::vector<int> index_of(map_.num_point_ids(), -1);
    for (std::size_t i = 0; i < index_.points.size(); ++i) {
      index_of[index_.points[i].index()] = static_cast<int>(i);
    }
    for (const MapPointId id : map_.PointIds()) {
      MapPoint& point = map_.point(id);
      const int i = index_of[id.index()];
      const bool is_unmoved =
          i >= 0 && before_.points[static_cast<std::size_t>(i)] == point.position;
      point.position = is_unmoved
                           ? solved_.problem.points[static_cast<std::size_t>(i)]
                           : motion_[point.observations.front().keyframe.index()] * point.position;
    }
  }

  const BundleIndex& index_;
  const BundleProblem& before_;
  const Solved& solved_;
  const SpanningTree& tree_;
  Map& map_;
  std::vector<Sim3d> motion_;  // new from old world, by keyframe id
};

}  // namespace

// The future waits for its thread.
void LoopBundle::Forget::operator()(Running* running) const { delete running; }

void LoopBundle::Begin(const Map& map) {
  GiveUp();
  if (!options_.enabled) return;
  running_.reset(new Running);
  running_->before = MakeBundleProblem(map.KeyFrameIds(), {}, map, running_->index);
  running_->keyframes_left = options_.merge_after_keyframes;
  running_->result = std::async(std::launch::async, Solve, running_->before, options_.bundle);
}

std::optional<LoopBundleReport> LoopBundle::KeyFrameAdded(const SpanningTree& tree, Map& map) {
  if (!running_ || --running_->keyframes_left > 0) return std::nullopt;
  const Timer wait_timer;
  const Solved solved = running_->result.get();
  LoopBundleReport report;
  report.wait_ms = wait_timer.ElapsedMs();
  report.solve_ms = solved.solve_ms;
  const auto running = std::move(running_);
  if (!solved.report.usable) return std::nullopt;

  const Timer merge_timer;
  report.keyframes = static_cast<int>(running->before.cams_from_world.size());
  report.points = static_cast<int>(running->before.points.size());
  report.observations = static_cast<int>(running->before.observations.size());
  Merge merge(running->index, running->before, solved, tree, map);
  report.scale_of_keyframe = merge.Run();
  report.outliers = RemoveOutliers(running->index, running->before, solved.report.is_inlier, map);
  for (const MapPointId id : map.PointIds()) map.UpdateViewingRange(id);
  report.merge_ms = merge_timer.ElapsedMs();
  return report;
}

}  // namespace lift_slam
