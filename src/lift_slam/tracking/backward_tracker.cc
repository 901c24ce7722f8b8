#include "lift_slam/tracking/backward_tracker.h"

#include "lift_slam/matching/frame_matcher.h"
#include "lift_slam/tracking/frame_pose.h"
#include "lift_slam/tracking/local_map.h"

namespace lift_slam {
namespace {

constexpr float kWideRadiusFactor = 3.0F;

// Interpolates cam_from_world; share 0: a, 1: b.
Rigid3d Interpolate(const Rigid3d& a, const Rigid3d& b, double share) {
  const Eigen::Vector3d center =
      (1.0 - share) * a.TargetOriginInSource() + share * b.TargetOriginInSource();
  const Eigen::Quaterniond rotation = a.rotation.slerp(share, b.rotation);
  return {rotation, -(rotation * center)};
}

bool TrackOne(const Map& map, const TrackerOptions& options, Frame& frame,
              const std::vector<MapPointId>& points) {
  const float max_distance = map.view().thresholds.fixed.high;
  MatchLocalPoints(map, points, kWideRadiusFactor, max_distance, frame);
  if (OptimizeFramePose(map, options.pose, frame) < options.min_inliers_first) return false;
  const LocalMap local = CollectLocalMap(map, frame, options.max_local_keyframes);
  MatchLocalPoints(map, local.points, 1.0F, max_distance, frame);
  return OptimizeFramePose(map, options.pose, frame) >= options.min_inliers;
}

}  // namespace

std::vector<BackfilledFrame> TrackBackwards(const Map& map, const Frame& current,
                                            std::vector<Frame> waiting,
                                            const TrackerOptions& options) {
  const KeyFrame& first = map.keyframe(KeyFrameId(0));
  const std::vector<MapPointId> points = map.PointIds();
  std::vector<BackfilledFrame> backfilled;
  Rigid3d later = current.cam_from_world, velocity;
  for (auto frame = waiting.rbegin(); frame != waiting.rend(); ++frame) {
    if (frame->frame_index == first.frame_index) {
      velocity = first.cam_from_world * Inverse(later);
      later = first.cam_from_world;
      continue;
    }
    const auto span = static_cast<double>(current.frame_index - first.frame_index);
    frame->cam_from_world =
        frame->frame_index > first.frame_index
            ? Interpolate(first.cam_from_world, current.cam_from_world,
                          static_cast<double>(frame->frame_index - first.frame_index) / span)
            : velocity * later;
    if (!TrackOne(map, options, *frame, points)) {
      if (frame->frame_index < first.frame_index) break;
      continue;
    }
    backfilled.push_back({frame->frame_index, first.id,
                          frame->cam_from_world * Inverse(first.cam_from_world),
                          frame->CountMatches()});
    velocity = frame->cam_from_world * Inverse(later);
    later = frame->cam_from_world;
  }
  return backfilled;
}

}  // namespace lift_slam
