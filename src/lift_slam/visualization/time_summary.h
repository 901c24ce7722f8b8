#pragma once

#include <cstddef>
#include <vector>

namespace lift_slam {

// Times of a stage in few numbers; all zero when it never ran.
struct TimeSummary {
  std::size_t runs = 0;
  double median_ms = 0.0;  // of an even count: mean of the middle two
  double mean_ms = 0.0;
  double p95_ms = 0.0;  // 95 % of the times are not above it
  double max_ms = 0.0;
  double total_s = 0.0;
};

TimeSummary SummarizeTimes(std::vector<double> times_ms);

}  // namespace lift_slam
