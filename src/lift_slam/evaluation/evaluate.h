#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lift_slam/evaluation/association.h"
#include "lift_slam/evaluation/coverage.h"
#include "lift_slam/evaluation/error_statistics.h"
#include "lift_slam/evaluation/evaluation_options.h"
#include "lift_slam/evaluation/kitti_error.h"
#include "lift_slam/evaluation/relative_pose_error.h"
#include "lift_slam/evaluation/scale_drift.h"
#include "lift_slam/geometry/alignment.h"
#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// Errors of one estimated pose, for plots over time.
struct FrameError {
  std::int64_t frame_index = -1;
  std::int64_t timestamp_ns = 0;  // of the estimate, without offset
  double position_m = 0.0;
  double rotation_deg = 0.0;
};

// Which of a run's trajectories was judged.
enum class TrajectoryKind { kFinal, kOnline, kKeyframes };
std::string_view Name(TrajectoryKind kind);

// Everything measured on one trajectory. Errors are absent, with the reason in
// `no_errors_reason`, when there is no reference, no pose, or a degenerate alignment; coverage and
// status are always there. A status of failure does not remove the errors: tables print an X.
struct EvaluationResult {
  std::string dataset, sequence;  // names for the tables; empty when unknown
  TrajectoryKind kind = TrajectoryKind::kFinal;
  EvaluationOptions options;  // as used

  Association association;  // pairs as read, before the alignment
  std::optional<Sim3d> reference_from_estimate;
  std::size_t num_alignment_pairs = 0;
  std::string no_errors_reason;

  std::optional<ErrorStatistics> ate_m;             // absolute position error
  std::optional<ErrorStatistics> ate_rotation_deg;  // absolute rotation error
  std::optional<KittiError> kitti;                  // only for pairs by index
  std::optional<RelativePoseError> rpe;
  std::optional<ScaleDrift> scale_drift;
  std::vector<FrameError> frame_errors;  // one for each pair
  Trajectory aligned_estimate;  // the estimate in the reference's world; empty without alignment

  Coverage coverage;
  RunStatus status = RunStatus::kFailInit;
};

// Judges an estimate against a reference, both sorted by time and in the frame named by
// options.gt_frame; all numbers and definitions in docs/evaluation.md. An empty reference is
// allowed when the estimate lists every frame: coverage and status only.
// Throws InputError for options out of range, poses that are not finite, and no pair at all.
EvaluationResult Evaluate(const Trajectory& estimate, const Trajectory& reference,
                          const EvaluationOptions& options);

// Diagnostic, never a headline: each map of a run aligned by itself, which hides the jumps of
// scale between them. `map_of_entry` gives the map of each entry of the estimate, -1 for none.
struct MapEvaluation {
  int map_index = 0;
  std::size_t num_poses = 0;
  std::optional<ErrorStatistics> ate_m;
};
std::vector<MapEvaluation> EvaluateEachMap(const Trajectory& estimate,
                                           const std::vector<int>& map_of_entry,
                                           const Trajectory& reference,
                                           const EvaluationOptions& options);

}  // namespace lift_slam
