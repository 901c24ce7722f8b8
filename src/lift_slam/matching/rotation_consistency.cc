#include "lift_slam/matching/rotation_consistency.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace lift_slam {
namespace {

// A second or third angle counts when at least this share of the first one's matches has it.
constexpr double kMinShareOfBest = 0.1;
constexpr std::size_t kKeptBins = 3;

}  // namespace

void RotationConsistency::Add(float angle_a_rad, float angle_b_rad, int match) {
  const double turns = (static_cast<double>(angle_a_rad) - angle_b_rad) / (2.0 * std::numbers::pi);
  const int bin = static_cast<int>(std::lround((turns - std::floor(turns)) * kBins)) % kBins;
  entries_.push_back({bin, match});
}

std::vector<int> RotationConsistency::Outliers() const {
  std::array<int, kBins> counts{};
  for (const Entry& entry : entries_) ++counts[static_cast<std::size_t>(entry.bin)];
  std::array<std::size_t, kBins> order;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return counts[a] > counts[b]; });
  std::array<bool, kBins> kept{};
  for (std::size_t i = 0; i < kKeptBins; ++i) {
    kept[order[i]] = counts[order[i]] >= kMinShareOfBest * counts[order[0]];
  }
  std::vector<int> outliers;
  for (const Entry& entry : entries_) {
    if (!kept[static_cast<std::size_t>(entry.bin)]) outliers.push_back(entry.match);
  }
  return outliers;
}

}  // namespace lift_slam
