#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lift_slam {

// The middle one of at least one value; of an even number the upper of the two in the middle.
template <class T>
T Median(std::vector<T> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace lift_slam
