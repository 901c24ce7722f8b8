#include "lift_slam/datasets/time_order.h"

#include <algorithm>
#include <cstddef>

#include "lift_slam/util/median.h"

namespace lift_slam {

// Longest increasing subsequence (patience sorting), run from the end so that ties go to the
// earlier frame. starts[n] is the position where the best run of n + 1 stamps begins.
std::vector<bool> KeepIncreasing(std::span<const std::int64_t> timestamps_ns) {
  const std::size_t count = timestamps_ns.size();
  std::vector<std::size_t> starts;
  std::vector<std::size_t> next(count, count);  // of the run that begins here
  for (std::size_t i = count; i-- > 0;) {
    const auto later = [&](std::size_t start, std::int64_t stamp) {
      return timestamps_ns[start] > stamp;
    };
    const auto slot = std::lower_bound(starts.begin(), starts.end(), timestamps_ns[i], later);
    if (slot != starts.begin()) next[i] = *(slot - 1);
    if (slot == starts.end()) {
      starts.push_back(i);
    } else {
      *slot = i;
    }
  }
  std::vector<bool> keep(count, false);
  for (std::size_t i = starts.empty() ? count : starts.back(); i < count; i = next[i]) {
    keep[i] = true;
  }
  return keep;
}

double MedianRateHz(std::span<const std::int64_t> timestamps_ns) {
  if (timestamps_ns.size() < 2) return 0.0;
  // Unsigned, as the step between two far apart stamps need not fit a signed number.
  std::vector<std::uint64_t> steps_ns;
  for (std::size_t i = 1; i < timestamps_ns.size(); ++i) {
    steps_ns.push_back(static_cast<std::uint64_t>(timestamps_ns[i]) -
                       static_cast<std::uint64_t>(timestamps_ns[i - 1]));
  }
  const std::uint64_t step_ns = Median(std::move(steps_ns));
  return step_ns > 0 ? 1e9 / static_cast<double>(step_ns) : 0.0;
}

}  // namespace lift_slam
