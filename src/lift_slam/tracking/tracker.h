#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "lift_slam/map/map.h"
#include "lift_slam/matching/adaptive_thresholds.h"
#include "lift_slam/tracking/motion_prior.h"
#include "lift_slam/tracking/tracker_options.h"
#include "lift_slam/tracking/tracking_state.h"

namespace lift_slam {

struct TrackingResult {
  FrameRefusal refusal = FrameRefusal::kNone;  // kNone: the frame has a pose
  int num_matches = 0;                         // before the final pose optimisation
  int num_inliers = 0;
  KeyFrameId reference;  // the frame's pose is kept relative to it
  bool needs_keyframe = false;
  int num_visible = 0;            // points of the local map that the frame should see
  bool recovered = false;         // found again without a prediction
  MatchingThresholds thresholds;  // that the frame was tracked with
  int num_last_matches = 0;       // with the last frame's points; 0 when they gave no pose
  int num_last_outliers = 0;      // of these, that disagree with the pose
};

// Image to pose within one map (paper sec. 3.2 "Tracking"): predict by constant velocity, match
// the last frame's points, optimise the pose; then match the local map and optimise again. When
// the prediction fails: the recent keyframes by descriptors alone.
class Tracker {
 public:
  Tracker(const TrackerOptions& options, const MatchingOptions& matching, std::uint64_t seed)
      : options_(options), matching_(matching), seed_(seed), prior_(options.motion_prior) {}

  // Starts in a map whose newest keyframe is `last` (pose and matches valid).
  void Start(const Map& map, const Frame& last, std::optional<Rigid3d> velocity);

  // Gives the frame its pose and matches; updates the points' visibility counts.
  TrackingResult Track(Map& map, Frame& frame);

  // The next frame cannot be predicted from the last one: there is a gap in the input.
  void ForgetMotion() {
    last_was_tracked_ = false;
    velocity_.reset();
  }

  // The last tracked frame became `keyframe` and local mapping has run: take over its new pose,
  // matches and points.
  void KeyFrameMapped(const Map& map, KeyFrameId keyframe);

  // A lost frame that looks like these keyframes, best first: tried one after another, by
  // descriptors alone. Succeeds with more points than tracking needs, and a good share of those
  // that should be seen; otherwise everything is as before.
  TrackingResult Relocalize(Map& map, Frame& frame, std::span<const KeyFrameId> similar);

  // The share of visible points that frames of this map see, before any was tracked here.
  void ExpectFoundRatio(double ratio) { usual_found_ratio_ = ratio; }

  // The map has been corrected and `keyframe` is the last tracked frame: lengths in its camera
  // frame were multiplied by `scale`.
  void MapCorrected(const Map& map, KeyFrameId keyframe, double scale);

  // Those that new map points are made with.
  MatchingThresholds MappingThresholds(const Map& map) const {
    const ThresholdRange& range = map.view().thresholds;
    const AdaptiveThresholds strict;
    return (range.moves_new_points ? adaptive_ : strict).In(range, matching_.thresholds);
  }

 private:
  MatchingThresholds Thresholds(const Map& map) const {
    return adaptive_.In(map.view().thresholds, matching_.thresholds);
  }
  struct LocalTrack {
    KeyFrameId reference;
    std::vector<MapPointId> visible;
  };

  // Whether constant velocity can be trusted to lead to this frame.
  bool IsExpectable(const Frame& frame) const;
  // Whether the frame comes as long after the last one as that one did after its own.
  bool IsAtUsualInterval(const Frame& frame) const;
  // The last motion, over the time since. Only with a velocity.
  Rigid3d ExpectedMotion(const Frame& frame) const;
  void ForgetExpected();
  bool TrackWithMotionModel(const Map& map, Frame& frame, TrackingResult& result);
  bool TrackReferenceKeyFrame(const Map& map, Frame& frame);
  bool Recover(const Map& map, Frame& frame);
  MatchingThresholds LoosestThresholds(const Map& map) const;
  bool TryKeyFrame(const Map& map, KeyFrameId keyframe, Frame& frame) const;
  // Whether enough points agree with the pose. What it finds counts once the frame is tracked.
  bool TrackLocalMap(const Map& map, Frame& frame, bool wide, TrackingResult& result,
                     LocalTrack& local) const;
  TrackingResult Refuse(FrameRefusal refusal, Frame& frame, TrackingResult result);
  TrackingResult Conclude(const LocalTrack& local, const Frame& frame, TrackingResult result,
                          Map& map);
  void Remember(const Frame& frame);

  TrackerOptions options_;
  MatchingOptions matching_;
  AdaptiveThresholds adaptive_;
  std::uint64_t seed_;
  Frame last_;
  bool last_was_tracked_ = false;
  std::optional<Rigid3d> velocity_;  // cam_from_last_cam
  std::int64_t velocity_interval_ns_ = 0;
  int num_by_motion_ = 0;  // frames in a row that constant velocity led to
  MotionPrior prior_;
  KeyFrameId reference_;
  int frames_since_keyframe_ = 0;
  double usual_found_ratio_ = 0.0;  // inliers over visible points of tracked frames, smoothed
};

}  // namespace lift_slam
