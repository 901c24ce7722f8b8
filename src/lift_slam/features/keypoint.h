#pragma once

#include <cstdint>

namespace lift_slam {

// A keypoint in the full-size image. Pixel (0, 0) is the CENTRE of the top-left pixel, whatever
// pyramid level it was found on.
struct Keypoint {
  float x = 0.0F, y = 0.0F;  // pixels in the full-size image
  float angle_rad = 0.0F;    // orientation, in (-pi, pi], x right, y down
  float response = 0.0F;     // detector score; larger is stronger
  std::int32_t level = 0;    // pyramid level, 0 is full size
};

}  // namespace lift_slam
