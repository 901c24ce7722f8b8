#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lift_slam {

// Marks the timestamps to keep so that they increase strictly and as few as possible are left
// out: one wrong stamp costs one frame, whichever way it is wrong. Of equal stamps the first is
// kept, and of two that stand the wrong way round the later one is left out.
std::vector<bool> KeepIncreasing(std::span<const std::int64_t> timestamps_ns);

// One over the median step of increasing timestamps; 0 for fewer than two.
double MedianRateHz(std::span<const std::int64_t> timestamps_ns);

}  // namespace lift_slam
