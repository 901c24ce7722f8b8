#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/simulation/rendering/pinhole_view.h"

namespace lift_slam {

// Supersampling so that one sample lies exactly on each pixel's centre, whose depth is then exact.
// Odd factors: s x s samples inside the pixel, equal weights. Even factors: s + 1 samples a
// direction, the outer ones on the pixel's border and shared with the neighbour (the trapezoidal
// rule, weights 1 2 ... 2 1). Either way the mean over the pixel's area.

// The pinhole whose samples those are.
PinholeIntrinsics SamplePinhole(const PinholeIntrinsics& pinhole, int supersampling);

// Index of the sample (in either direction) on the centre of a pixel.
inline int CenterSample(int pixel, int supersampling) {
  return supersampling * pixel + supersampling / 2;
}

// samples: RGBA of SamplePinhole's size; result: RGB of the pinhole's size. Rows from the top.
std::vector<std::uint8_t> DownsampleColor(const std::vector<std::uint8_t>& samples,
                                          const PinholeIntrinsics& pinhole, int supersampling);

// samples: depth buffer of SamplePinhole's size; result: z at each pixel's centre, 0: nothing
// there.
std::vector<float> CenterDepth(const std::vector<float>& samples, const PinholeIntrinsics& pinhole,
                               int supersampling, const DepthRange& range);

}  // namespace lift_slam
