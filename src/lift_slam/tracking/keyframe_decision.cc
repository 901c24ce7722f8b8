#include "lift_slam/tracking/keyframe_decision.h"

namespace lift_slam {
namespace {

// Points of the keyframe that enough keyframes see to be trusted.
int CountReliablePoints(const Map& map, KeyFrameId keyframe, int min_observations) {
  if (map.num_keyframes() <= 2) min_observations = 2;
  int count = 0;
  for (const MapPointId id : map.keyframe(keyframe).map_points) {
    if (id.valid() && map.point(id).num_observations() >= min_observations) ++count;
  }
  return count;
}

}  // namespace

bool ShouldBecomeKeyFrame(const Map& map, int num_tracked, KeyFrameId reference,
                          int frames_since_keyframe, const KeyFrameDecisionOptions& options) {
  if (num_tracked < options.min_tracked_points) return false;
  if (frames_since_keyframe < options.min_frames_between) return false;
  if (frames_since_keyframe >= options.max_frames_between) return true;
  return num_tracked <
         options.max_tracked_ratio * CountReliablePoints(map, reference, options.min_observations);
}

}  // namespace lift_slam
