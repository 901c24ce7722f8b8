#include "lift_slam/evaluation/run_statistics.h"

#include "lift_slam/evaluation/error_statistics.h"

namespace lift_slam {

RunStatistics SummarizeRuns(const std::vector<RunOutcome>& runs) {
  RunStatistics result;
  result.num_runs = static_cast<int>(runs.size());
  std::vector<double> values;
  for (const RunOutcome& run : runs) {
    if (IsFailure(run.status) || !run.value) continue;
    values.push_back(*run.value);
    if (run.status == RunStatus::kPartial) ++result.num_partial;
  }
  result.num_used = static_cast<int>(values.size());
  const auto statistics = Summarize(values);
  if (!statistics) return result;
  result.mean = statistics->mean;
  result.median = statistics->median;
  result.min = statistics->min;
  result.max = statistics->max;
  return result;
}

}  // namespace lift_slam
