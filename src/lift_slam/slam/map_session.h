#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/local_mapping/local_mapper.h"
#include "lift_slam/loop_closing/loop_closer.h"
#include "lift_slam/map/map_file.h"
#include "lift_slam/slam/frame_preparer.h"
#include "lift_slam/slam/run_record.h"
#include "lift_slam/slam/slam_options.h"
#include "lift_slam/tracking/backward_tracker.h"
#include "lift_slam/tracking/map_initializer.h"
#include "lift_slam/tracking/tracker.h"

namespace lift_slam {

// One map from its first two views to its end, with the tracker and mapper that work on it and the
// frames tracked in it.
class MapSession {
 public:
  // A tracked frame, kept relative to its reference keyframe.
  struct FrameReference {
    std::int64_t frame_index = -1;
    KeyFrameId reference;
    Rigid3d cam_from_reference;
  };

  // Without a vocabulary no place is recognised.
  MapSession(InitialMap initial, const GrayImage& image, const SlamOptions& options,
             std::shared_ptr<const Vocabulary> vocabulary);
  // Takes up a map of an earlier run; no frame is tracked in it yet.
  MapSession(StoredMap stored, const SlamOptions& options,
             std::shared_ptr<const Vocabulary> vocabulary);

  struct Step {
    TrackingResult tracking;
    std::optional<MappingReport> mapping;  // when the frame became a keyframe
    std::optional<LoopReport> loop;        // the same, with a vocabulary
    Rigid3d world_from_cam;                // valid when tracked
    std::vector<int> tracked_features;     // features that agree with a map point
    double track_ms = 0.0, map_ms = 0.0;
  };
  Step Process(const PreparedFrame& prepared);
  // The next frame comes after a gap in the input and is found without prediction.
  void ForgetMotion() { tracker_.ForgetMotion(); }
  // Looks for a lost frame in the whole map by its words (nothing without a vocabulary); refused
  // when it shows no place of the map.
  Step Relocalize(const PreparedFrame& prepared);

  // Looks for the newest keyframe of this map in another one; see LoopCloser::FindInOtherMap.
  LoopReport FindNewestIn(const MapSession& other) const;
  // Takes over all of another session, whose map shows the place of `attempt`: its candidate is
  // this map's and its query the other's newest keyframe, or the other way round. Tracking goes on
  // from the query, which is the frame tracked last.
  enum class MergeSide { kQueryIsOthers, kQueryIsMine };
  FusionCounts Absorb(MapSession&& other, const PlaceAttempt& attempt, MergeSide side);

  const Map& map() const { return *map_; }
  Map& mutable_map() { return *map_; }
  const std::vector<FrameReference>& frames() const { return frames_; }
  // Keyframe that stands for a frame's place in a report; -1: gone, or of an earlier run.
  std::int64_t FrameIndexOf(KeyFrameId keyframe) const;
  // After the last frame: bundle adjustment of the whole map and self-calibration; the correction
  // is kept. A long map is calibrated first, on a part, and adjusted once. Frames keep their
  // places between the keyframes.
  void AdjustFinally(const BundleOptions& bundle, const SelfCalibrationOptions& calibration,
                     StageTimes& times_ms);
  // Brings the map, which self-calibration may have moved, back to the calibration that was given
  // and its pixels obey. Frames are not moved along: call after all else, before storing it.
  void PrepareToStore(const BundleOptions& bundle);
  // Refers to this session.
  MapToStore ToStore() const;
  // An earlier run has begun the map.
  bool is_loaded() const { return is_loaded_; }
  // The run has added to the map or moved it.
  bool is_of_this_run() const { return !is_loaded_ || has_new_keyframes_; }
  // What self-calibration found, or why it did not.
  const SelfCalibrationReport& calibration() const { return calibration_; }
  CalibrationCorrection correction() const { return calibration_.correction(); }
  int num_backfilled() const { return num_backfilled_; }
  // Grey value of the pixel a point was made from.
  std::uint8_t GrayOf(MapPointId id) const {
    return id.index() < gray_.size() ? gray_[id.index()] : 128;
  }

 private:
  void Backfill(std::vector<Frame> waiting, const Frame& current);
  void InsertKeyFrame(const GrayImage& image, Frame& frame, Step& step);
  void Finish(const PreparedFrame& prepared, Frame& frame, Step& step);
  // The map has been moved as a whole: frames and tracker go with it.
  void FollowMap(const std::vector<double>& scale_of_keyframe, KeyFrameId newest);
  // Frames follow their reference keyframes, by id, whose lengths have changed by these factors.
  void ScaleFrames(const std::vector<double>& scale_of_keyframe);
  void RememberGray(KeyFrameId keyframe, const GrayImage& image);

  std::unique_ptr<Map> map_;
  Tracker tracker_;
  LocalMapper mapper_;
  std::optional<LoopCloser> loop_closer_;
  LoopCorrectionOptions correction_options_;
  TrackerOptions tracker_options_;
  std::vector<FrameReference> frames_;
  std::optional<Rigid3d> initial_velocity_;
  std::vector<std::uint8_t> gray_;  // by point id
  int num_backfilled_ = 0;
  bool is_loaded_ = false;
  bool has_new_keyframes_ = false;  // of this run
  bool localization_only_ = false;
  SelfCalibrationReport calibration_;
};

}  // namespace lift_slam
