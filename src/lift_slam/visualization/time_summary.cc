#include "lift_slam/visualization/time_summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lift_slam {

TimeSummary SummarizeTimes(std::vector<double> times_ms) {
  TimeSummary summary;
  summary.runs = times_ms.size();
  if (times_ms.empty()) return summary;
  std::sort(times_ms.begin(), times_ms.end());
  const std::size_t n = times_ms.size();
  const double sum_ms = std::accumulate(times_ms.begin(), times_ms.end(), 0.0);
  summary.median_ms = 0.5 * (times_ms[(n - 1) / 2] + times_ms[n / 2]);
  summary.mean_ms = sum_ms / static_cast<double>(n);
  summary.p95_ms = times_ms[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(n))) - 1];
  summary.max_ms = times_ms.back();
  summary.total_s = sum_ms * 1e-3;
  return summary;
}

}  // namespace lift_slam
