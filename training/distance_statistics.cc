#include "training/distance_statistics.h"

#include <algorithm>
#include <array>

#include "lift_slam/util/check.h"

namespace lift_slam::training {
namespace {

void Append(const torch::Tensor& values, std::vector<float>& target) {
  const torch::Tensor flat = values.contiguous();
  const float* data = flat.data_ptr<float>();
  target.insert(target.end(), data, data + flat.numel());
}

float Quantile(std::vector<float> values, double share) {
  LIFT_SLAM_CHECK(!values.empty(), "no distances");
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

void DistanceStatistics::Add(const torch::Tensor& distances, const torch::Tensor& different) {
  constexpr double kFar = 1e6;
  Append(distances.diagonal(), matching_);
  Append(distances.masked_fill(different.logical_not(), kFar).amin(1), nearest_wrong_);
  Append(distances.masked_select(different), different_);
}

double DistanceStatistics::FalsePositiveRate95() const {
  if (different_.empty()) return 1.0;
  const float threshold = Quantile(matching_, 0.95);
  const auto below = std::count_if(different_.begin(), different_.end(),
                                   [&](float distance) { return distance <= threshold; });
  return static_cast<double>(below) / static_cast<double>(different_.size());
}

double DistanceStatistics::NearestCorrect() const {
  std::size_t right = 0;
  for (std::size_t i = 0; i < matching_.size(); ++i) {
    right += matching_[i] < nearest_wrong_[i] ? 1 : 0;
  }
  return matching_.empty() ? 0.0
                           : static_cast<double>(right) / static_cast<double>(matching_.size());
}

DistanceQuantiles DistanceStatistics::Quantiles() const {
  constexpr std::array kShares = {0.05, 0.25, 0.5, 0.75, 0.95};
  DistanceQuantiles quantiles;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    quantiles.matching[i] = Quantile(matching_, kShares[i]);
    quantiles.nearest_wrong[i] = Quantile(nearest_wrong_, kShares[i]);
  }
  return quantiles;
}

}  // namespace lift_slam::training
