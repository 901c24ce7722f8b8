#pragma once

#include <optional>
#include <vector>

#include "lift_slam/evaluation/coverage.h"

namespace lift_slam {

// One run of several with the same sequence and configuration.
struct RunOutcome {
  RunStatus status = RunStatus::kFailInit;
  std::optional<double> value;  // the figure to summarise; nothing when it could not be measured
};

// Figures of repeated runs. Only OK and PARTIAL runs with a value count; failed runs are shown by
// num_used < num_runs and never left out of num_runs.
struct RunStatistics {
  int num_runs = 0;
  int num_used = 0;     // "k of num_runs"; the other members mean nothing when it is 0
  int num_partial = 0;  // among the used
  double mean = 0.0;
  double median = 0.0;
  double min = 0.0;
  double max = 0.0;
};

RunStatistics SummarizeRuns(const std::vector<RunOutcome>& runs);

}  // namespace lift_slam
