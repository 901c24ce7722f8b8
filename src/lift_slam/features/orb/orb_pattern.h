#pragma once

#include <array>
#include <cstddef>

namespace lift_slam {

// The pixel pairs that ORB compares, relative to an upright corner: bit i is set when the smoothed
// image is darker at (first_x[i], first_y[i]) than at (second_x[i], second_y[i]).
struct OrbPattern {
  static constexpr std::size_t kBits = 256;
  std::array<float, kBits> first_x, first_y, second_x, second_y;
};

// The pattern learned by ORB's authors, as OpenCV has it. OpenCV does not hand it out: it is found
// once, in about a millisecond, by describing an image of a single dot.
const OrbPattern& OpenCvOrbPattern();

}  // namespace lift_slam
