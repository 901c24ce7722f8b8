#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/slam/run_record.h"
#include "lift_slam/util/provenance.h"
#include "lift_slam/visualization/report_data.h"

namespace lift_slam {

// What a run's trajectories are worth.
struct RunEvaluation {
  EvaluationResult final_trajectory;  // the headline; coverage and status always
  std::optional<ErrorStatistics> online_ate_m, keyframes_ate_m;  // each aligned by itself
};

// Judges a run. An empty truth gives coverage and status alone. Truth that does not fit (no common
// time) loses the errors, not the run: the reason is in no_errors_reason. `options.
// estimate_lists_every_frame` is set as needed.
RunEvaluation EvaluateRun(const RunRecord& run, const Trajectory& truth, EvaluationOptions options);

// Everything that is known when a run has ended.
struct FinishedRun {
  // `r` must outlive it.
  FinishedRun(const RunRecord& r, RunEvaluation e) : run(r), evaluation(std::move(e)) {}

  const RunRecord& run;
  RunEvaluation evaluation;
  std::string dataset, sequence;             // "kitti", "00"
  std::string configuration;                 // short name for tables of results: "orb"
  std::string config_yaml;                   // effective options
  Trajectory ground_truth;                   // metres; may be empty
  TopView ground_truth_view = TopView::kXY;  // kXZ for KITTI
  Provenance provenance;
  // Further rows of the provenance, shown and stored as they are: {"mode", "sequential"},
  // {"seed", "0"}, {"settings_sha256", of all but the seed}, {"source", path}, {"calibration",
  // file}, {"ground truth", file}, {"weights", SHA-256}...
  std::vector<std::pair<std::string, std::string>> settings;
  // Warnings of the readers, shown in the report.
  std::vector<std::string> warnings;
  // File name of a frame's image, for the COLMAP model; when empty "000012.png".
  std::function<std::string(std::int64_t)> image_name;
};

}  // namespace lift_slam
