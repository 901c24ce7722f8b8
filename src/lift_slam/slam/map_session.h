#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/local_mapping/local_mapper.h"
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

  MapSession(InitialMap initial, const GrayImage& image, const SlamOptions& options);

  struct Step {
    TrackingResult tracking;
    std::optional<MappingReport> mapping;  // when the frame became a keyframe
    Rigid3d world_from_cam;                // valid when tracked
    std::vector<int> tracked_features;     // features that agree with a map point
    double track_ms = 0.0, map_ms = 0.0;
  };
  Step Process(const PreparedFrame& prepared);

  const Map& map() const { return *map_; }
  Map& mutable_map() { return *map_; }
  const std::vector<FrameReference>& frames() const { return frames_; }
  // After the last frame: bundle adjustment of the whole map and self-calibration; the correction
  // is kept. A long map is calibrated first, on a part, and adjusted once.
  void AdjustFinally(const BundleOptions& bundle, const SelfCalibrationOptions& calibration,
                     StageTimes& times_ms);
  const CalibrationCorrection& correction() const { return correction_; }
  int num_backfilled() const { return num_backfilled_; }
  // Grey value of the pixel a point was made from.
  std::uint8_t GrayOf(MapPointId id) const {
    return id.index() < gray_.size() ? gray_[id.index()] : 128;
  }

 private:
  void Backfill(std::vector<Frame> waiting, const Frame& current);
  MappingReport InsertKeyFrame(Frame& frame, const GrayImage& image);
  void RememberGray(KeyFrameId keyframe, const GrayImage& image);

  std::unique_ptr<Map> map_;
  Tracker tracker_;
  LocalMapper mapper_;
  TrackerOptions tracker_options_;
  std::vector<FrameReference> frames_;
  std::optional<Rigid3d> initial_velocity_;
  std::vector<std::uint8_t> gray_;  // by point id
  int num_backfilled_ = 0;
  CalibrationCorrection correction_;
};

}  // namespace lift_slam
