#include "apps/finished_run.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

Trajectory KeyframeTrajectory(const RunRecord& run) {
  Trajectory trajectory;
  for (const KeyFrameRecord& keyframe : run.keyframes) {
    if (!keyframe.is_loaded) trajectory.push_back(keyframe.pose);
  }
  return trajectory;
}

std::optional<ErrorStatistics> AteOf(const Trajectory& estimate, const Trajectory& truth,
                                     EvaluationOptions options, bool lists_every_frame) {
  options.estimate_lists_every_frame = lists_every_frame;
  try {
    return Evaluate(estimate, truth, options).ate_m;
  } catch (const InputError&) {
    return std::nullopt;  // no pair; the final trajectory's result says so
  }
}

}  // namespace

RunEvaluation EvaluateRun(const RunRecord& run, const Trajectory& truth,
                          EvaluationOptions options) {
  options.estimate_lists_every_frame = true;
  RunEvaluation evaluation;
  EvaluationResult& result = evaluation.final_trajectory;
  try {
    result = Evaluate(run.final_trajectory, truth, options);
  } catch (const InputError& error) {
    result = Evaluate(run.final_trajectory, {}, options);
    result.no_errors_reason = error.what();
  }
  result.coverage.maps = run.num_maps;
  result.coverage.relocalisations = run.relocalisations;
  result.coverage.loops_closed = run.loops_closed;
  if (result.ate_m) {
    evaluation.online_ate_m = AteOf(run.online_trajectory, truth, options, true);
    evaluation.keyframes_ate_m = AteOf(KeyframeTrajectory(run), truth, options, false);
  }
  return evaluation;
}

}  // namespace lift_slam
