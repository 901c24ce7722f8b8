#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/geometry/trajectory.h"
#include "lift_slam/image/image.h"
#include "lift_slam/loop_closing/place_match.h"
#include "lift_slam/optimization/self_calibration.h"
#include "lift_slam/tracking/tracking_state.h"

namespace lift_slam {

// What one frame of the input came to.
struct FrameRecord {
  std::int64_t frame_index = -1;  // in the source sequence
  std::int64_t timestamp_ns = 0;
  TrackingState state = TrackingState::kInitializing;  // after the frame
  FrameRefusal refusal = FrameRefusal::kNone;
  std::optional<Rigid3d> world_from_cam;  // online pose, map units; nothing when refused
  // Which map of the run holds the final pose; -1: none (no pose, or its map was thrown away).
  int map_index = -1;
  bool is_keyframe = false;
  int num_impulses = 0;  // pixels of salt-and-pepper noise that were taken out
  int num_features = 0;
  int num_matches = 0;  // map points matched before the final pose optimisation
  int num_inliers = 0;  // map points that agree with the pose
  // Adaptive thresholds (paper sec. 3.4, Fig. 5): the distances that descriptors were held to,
  // the matches with the last frame's map points, and the outliers of these.
  float low_threshold = 0.0F, high_threshold = 0.0F;  // 0: no tracking
  int num_last_matches = 0, num_last_outliers = 0;
  double extract_ms = 0.0;
  double track_ms = 0.0;  // without extraction
  double map_ms = 0.0;    // local mapping after this frame; 0 when no keyframe
};

// A map point as handed out: position in its map's frame, and where it was seen.
struct PointRecord {
  struct Observation {
    int keyframe = 0;          // index into RunRecord::keyframes
    float x = 0.0F, y = 0.0F;  // undistorted pixel of the ideal pinhole
  };
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  int map_index = 0;
  float reprojection_error_px = 0.0F;  // mean over the observations
  std::uint8_t gray = 128;             // intensity of the pixel it was created from
  std::vector<Observation> observations;
};

struct KeyFrameRecord {
  TrajectoryPose pose;  // final
  int map_index = 0;
  bool is_loaded = false;  // of an earlier run, whose frame index and time the pose has
};

enum class PlaceEventKind { kLoop, kMerge, kRelocalisation };
std::string_view Name(PlaceEventKind kind);  // "loop"

// A keyframe that looked like an earlier one and was compared with it by geometry; or a lost frame
// that was found again by its look.
struct PlaceEvent {
  PlaceEventKind kind = PlaceEventKind::kLoop;
  PlaceRejection rejection = PlaceRejection::kAccepted;
  std::int64_t frame_index = -1;        // in the source sequence
  std::int64_t other_frame_index = -1;  // of the earlier one
  double score = 0.0;                   // of the images' words; 0 for a relocalisation
  int num_word_matches = 0, num_inliers = 0, num_projected = 0, num_confirming = 0;
  // See PlaceMatch.
  double found_ratio = 0.0, own_found_ratio = 0.0, mutual_ratio = 0.0, offset_ratio = 0.0;
  // By which a closed loop changed lengths at this frame; of a merge, lengths of the other map
  // over those of this frame's.
  double scale = 1.0;
};

// A frame picture with its tracked points, for the report.
struct AnnotatedFrame {
  struct Mark {
    float x = 0.0F, y = 0.0F;  // pixel in the image as it was read
    bool tracked = false;      // agrees with a map point; else an unmatched feature
  };
  std::int64_t frame_index = -1;
  GrayImage image;
  TrackingState state = TrackingState::kInitializing;
  std::vector<Mark> marks;
};

// Times of one stage over the run, in milliseconds, one entry for each time it ran.
using StageTimes = std::map<std::string, std::vector<double>>;

// Everything a run leaves behind: data for trajectories, map, result.json and report.
struct RunRecord {
  Camera camera;
  std::vector<FrameRecord> frames;        // every input frame, in order
  Trajectory final_trajectory;            // every frame; state kOk where it has a final pose
  Trajectory online_trajectory;           // every frame; pose as given when it was processed
  std::vector<KeyFrameRecord> keyframes;  // of all maps kept, by time
  std::vector<PointRecord> points;        // of all maps kept
  std::vector<AnnotatedFrame> annotated_frames;
  std::vector<PlaceEvent> place_events;  // in order of time
  // By map: what self-calibration found the calibration to be off by, or why it was left as given.
  std::vector<SelfCalibrationReport> calibrations;
  StageTimes stage_times_ms;
  int num_maps = 0;     // maps kept
  int lost_events = 0;  // tracking -> lost
  int relocalisations = 0;
  int loops_closed = 0;
  int maps_merged = 0;
  std::string place_recognition_notice;  // why it was off; empty: it was on
  int num_cached_frames = 0;             // whose features came from a cache
  double wall_time_s = 0.0;              // whole run without start-up
  // How often each refusal happened, by FrameRefusal.
  std::array<int, static_cast<std::size_t>(FrameRefusal::kCount)> refusals{};
  // Why frames with a pose made no keyframe, why points were culled and so on: "stage.reason" -> n.
  std::map<std::string, int> counters;
  bool interrupted = false;  // ended by a signal before the input did
};

}  // namespace lift_slam
