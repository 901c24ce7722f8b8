#pragma once

#include <array>
#include <cstdint>

#include "lift_slam/image/image.h"

namespace lift_slam {

// Number of pixels of each grey value.
inline std::array<std::int64_t, 256> GrayHistogram(const GrayImage& image) {
  std::array<std::int64_t, 256> histogram{};
  for (int y = 0; y < image.height(); ++y) {
    const std::uint8_t* row = image.row(y);
    for (int x = 0; x < image.width(); ++x) ++histogram[row[x]];
  }
  return histogram;
}

}  // namespace lift_slam
