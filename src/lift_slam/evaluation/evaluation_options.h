#pragma once

#include <string_view>

#include "lift_slam/geometry/alignment.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// How poses of the estimate find their reference pose.
enum class AssociationMethod {
  kAuto,   // by index when both trajectories know their frame indices, else by time
  kIndex,  // equal frame index (KITTI)
  kTime,   // nearest timestamp (EuRoC, TUM)
};
inline constexpr std::string_view kAssociationMethodNames[] = {"auto", "index", "time"};

// Largest time differences in use for the data sets: EuRoC has a reference pose every 5 ms; 20 ms
// is the default of the TUM RGB-D scripts.
inline constexpr double kEurocMaxTimeDifferenceMs = 10.0;
inline constexpr double kTumMaxTimeDifferenceMs = 20.0;

struct AssociationOptions {
  AssociationMethod method = AssociationMethod::kAuto;
  // Poses further apart in time are no pair.
  double max_time_difference_ms = kTumMaxTimeDifferenceMs;
  // Added to the estimate's timestamps before pairing.
  double offset_s = 0.0;
  // Interpolate the denser trajectory at the stamps of the sparser one, between neighbours that
  // are both within twice max_time_difference_ms.
  bool interpolate = false;

  void Visit(OptionVisitor& visitor);
};

enum class RpeUnit { kFrames, kMetres };
enum class RpePairs { kAll, kConsecutive };
enum class RpePathSource { kReference, kEstimate };
inline constexpr std::string_view kRpeUnitNames[] = {"frames", "metres"};
inline constexpr std::string_view kRpePairsNames[] = {"all", "consecutive"};
inline constexpr std::string_view kRpePathSourceNames[] = {"reference", "estimate"};

struct RpeOptions {
  double delta = 1.0;  // distance of the two poses of a pair, in `unit`
  RpeUnit unit = RpeUnit::kFrames;
  // kAll: a pair from every pose; kConsecutive: pairs that do not overlap.
  RpePairs pairs = RpePairs::kAll;
  // Whose path is measured when the unit is metres.
  RpePathSource path_source = RpePathSource::kReference;

  void Visit(OptionVisitor& visitor);
};

// Limits between OK, PARTIAL and FAIL_LOST.
struct StatusThresholds {
  double min_ok_coverage = 0.9;       // share of frames with a pose; below: PARTIAL
  double min_partial_coverage = 0.5;  // below: FAIL_LOST
  double max_lost_at_end_s = 10.0;    // lost for longer at the end: FAIL_LOST

  void Visit(OptionVisitor& visitor);
};

// The frame whose positions the reference holds.
enum class GroundTruthFrame { kCamera, kBody };
inline constexpr std::string_view kGroundTruthFrameNames[] = {"cam", "body"};

struct EvaluationOptions {
  AssociationOptions association;
  AlignmentMode alignment = AlignmentMode::kSim3;  // a monocular map has no scale of its own
  int align_first = 0;  // fit the alignment to the first so many pairs; 0: to all
  RpeOptions rpe;
  StatusThresholds status;
  // Recorded with the result; the reference handed in must already be in this frame.
  GroundTruthFrame gt_frame = GroundTruthFrame::kCamera;

  // What the trajectory is, not how it is judged; no part of a configuration file.
  // True: one entry for each input frame, with its state. False: only poses, as from a file; then
  // the frames are those of the reference, or as many as the times of both say. frames_total above
  // 0 is the number of frames that the coverage is a share of.
  bool estimate_lists_every_frame = true;
  int frames_total = 0;

  void Visit(OptionVisitor& visitor);
  // Throws InputError when a value makes no sense.
  void Check() const;
};

}  // namespace lift_slam
