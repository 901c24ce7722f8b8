#pragma once

#include "lift_slam/map/map.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct KeyFrameDecisionOptions {
  // A keyframe is due when fewer than this share of the reference keyframe's points are tracked:
  // the view has changed (ORB-SLAM sec. V-E, which uses 0.9 of the points seen three times; here
  // all points count, so that a keyframe full of new points does not put off the next one).
  double max_tracked_ratio = 0.7;
  int min_observations = 2;     // keyframes that must see a reference point for it to count
  int max_frames_between = 30;  // frames; a keyframe at least this often
  int min_frames_between = 1;   // frames; 1: each frame may be one
  int min_tracked_points = 15;  // below this a frame is too weak to become a keyframe

  void Visit(OptionVisitor& visitor) {
    visitor.Field("max_tracked_ratio", max_tracked_ratio,
                  "tracked share of the reference keyframe's points that asks for a keyframe");
    visitor.Field("min_observations", min_observations,
                  "keyframes that must see a point of the reference keyframe for it to count");
    visitor.Field("max_frames_between", max_frames_between, "frames between keyframes at most");
    visitor.Field("min_frames_between", min_frames_between, "frames between keyframes at least");
    visitor.Field("min_tracked_points", min_tracked_points,
                  "map points a frame must track to become a keyframe");
  }
};

// Whether the frame should become a keyframe: a weak view of the map, or long since the last one.
bool ShouldBecomeKeyFrame(const Map& map, int num_tracked, KeyFrameId reference,
                          int frames_since_keyframe, const KeyFrameDecisionOptions& options);

}  // namespace lift_slam
