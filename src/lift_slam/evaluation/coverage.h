#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "lift_slam/evaluation/evaluation_options.h"
#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// One frame of the input and whether it has a pose.
struct FrameStatus {
  std::int64_t timestamp_ns = 0;
  std::optional<std::size_t> reference_index;  // the frame's place in the reference
  bool ok = false;
};

// Where the list of input frames comes from.
enum class FrameListSource {
  kEstimate,   // the estimate has one entry for each input frame
  kReference,  // the reference has one pose for each input frame (paired by index)
  kInferred,   // gaps and ends filled at the estimate's median rate over the reference's time
};
std::string_view Name(FrameListSource source);

struct FrameList {
  FrameListSource source = FrameListSource::kEstimate;
  std::vector<FrameStatus> frames;  // in order
};

// `method` must be resolved; `reference` may be empty when the estimate lists every frame.
FrameList ListFrames(const Trajectory& estimate, const Trajectory& reference,
                     AssociationMethod method, const EvaluationOptions& options);

// Numbers of frames, from 0 at the first stamp, where only the ascending times of some of them are
// known: a gap holds as many frames as the median interval fits into it.
std::vector<std::int64_t> FrameNumbers(const std::vector<std::int64_t>& stamps_ns);

// The estimate with one entry for each frame of the sequence: frames without a pose within half a
// millisecond become kNotInitialized before the first pose and kLost after it. Throws InputError
// when a pose belongs to no frame.
Trajectory WithEveryFrame(const Trajectory& estimate,
                          const std::vector<std::int64_t>& frame_timestamps_ns);

struct Coverage {
  FrameListSource source = FrameListSource::kEstimate;
  int frames_total = 0;
  int frames_ok = 0;
  double coverage = 0.0;          // frames_ok / frames_total; 0 without frames
  std::optional<int> init_frame;  // first frame with a pose, counted from 0; nothing: none
  int lost_events = 0;            // times a frame without pose follows one with a pose
  int longest_ok_run = 0;         // frames
  double lost_at_end_s = 0.0;     // from the last frame with a pose to the last frame
  // Reference length of consecutive frame pairs with poses / whole reference length over the
  // frames; nothing without a reference or when it does not move.
  std::optional<double> path_covered;
  // Known to the system alone; the program that ran it fills them in.
  std::optional<int> maps, relocalisations, loops_closed;
};

// `frames_total` above 0 replaces the number of listed frames; InputError when it is below the
// number of frames with a pose.
Coverage ComputeCoverage(const FrameList& list, const Trajectory& reference, int frames_total = 0);

enum class RunStatus { kOk, kPartial, kFailInit, kFailLost };
// As in result.json: "OK", "PARTIAL", "FAIL_INIT", "FAIL_LOST".
std::string_view Name(RunStatus status);
// True for the two states whose tables show an X.
bool IsFailure(RunStatus status);

RunStatus JudgeRun(const Coverage& coverage, const StatusThresholds& thresholds);

}  // namespace lift_slam
