#include "lift_slam/evaluation/error_statistics.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {

double Median(std::vector<double> values) {
  LIFT_SLAM_CHECK(!values.empty(), "median of nothing");
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::optional<ErrorStatistics> Summarize(const std::vector<double>& errors) {
  if (errors.empty()) return std::nullopt;
  const auto n = static_cast<double>(errors.size());
  ErrorStatistics statistics;
  statistics.count = errors.size();
  double sum_squares = 0.0;
  for (const double error : errors) {
    statistics.mean += error / n;
    sum_squares += error * error;
  }
  double sum_deviations = 0.0;
  for (const double error : errors) {
    sum_deviations += (error - statistics.mean) * (error - statistics.mean);
  }
  statistics.rmse = std::sqrt(sum_squares / n);
  statistics.std = std::sqrt(sum_deviations / n);
  statistics.median = Median(errors);
  statistics.min = *std::min_element(errors.begin(), errors.end());
  statistics.max = *std::max_element(errors.begin(), errors.end());
  return statistics;
}

}  // namespace lift_slam
