#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace lift_slam {

// Summary of a list of errors, in the unit of the errors.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;  // of an even count: mean of the middle two
  double std = 0.0;     // of the population (divided by count)
  double min = 0.0;
  double max = 0.0;
};

// Nothing when there is no error to summarise.
std::optional<ErrorStatistics> Summarize(const std::vector<double>& errors);

// Median; `values` must not be empty.
double Median(std::vector<double> values);

}  // namespace lift_slam
