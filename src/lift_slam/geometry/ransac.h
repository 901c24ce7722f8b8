#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lift_slam/util/random.h"

namespace lift_slam {

// How long random sampling goes on: until a sample without outliers has been drawn with
// `confidence`, within the limits.
struct RansacLimits {
  int min_iterations = 10;
  int max_iterations = 300;
  double confidence = 0.999;
};

// kSize distinct indices below `count` (count >= kSize), in the order drawn.
template <std::size_t kSize>
std::array<std::size_t, kSize> DrawSample(Random& random, std::size_t count) {
  std::array<std::size_t, kSize> sample{};
  for (std::size_t i = 0; i < kSize;) {
    sample[i] = static_cast<std::size_t>(random.UniformInt(0, static_cast<int>(count) - 1));
    bool is_new = true;
    for (std::size_t j = 0; j < i; ++j) is_new = is_new && sample[j] != sample[i];
    if (is_new) ++i;
  }
  return sample;
}

// Number of samples of `sample_size` needed when `inlier_ratio` of the data fit the model.
inline int RansacIterations(const RansacLimits& limits, double inlier_ratio, int sample_size) {
  const double clean = std::pow(inlier_ratio, sample_size);
  if (clean >= 1.0) return limits.min_iterations;
  const double needed = std::log(1.0 - limits.confidence) / std::log1p(-clean);
  if (!(needed < limits.max_iterations)) return limits.max_iterations;
  return std::max(limits.min_iterations, static_cast<int>(std::ceil(needed)));
}

}  // namespace lift_slam
