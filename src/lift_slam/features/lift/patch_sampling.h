#pragma once

#include <cstdint>
#include <span>

#include "lift_slam/image/image.h"

namespace lift_slam {

// A square in an image that a patch covers. Pixel (0, 0) is the centre of the top-left pixel.
struct PatchFrame {
  double x = 0.0, y = 0.0;     // centre
  double half_width_px = 1.0;  // from the centre to the centres of the outermost samples
  double angle_rad = 0.0;      // the patch's +x axis points along (cos, sin) in the image, y down
};

// LIFT looks at 6 sigma to each side of a keypoint, for orientation and descriptor.
inline constexpr double kLiftHalfWidthSigmas = 6.0;

// size x size samples, row by row, bilinear, the image continued beyond its border by its outermost
// pixels: with u, v from -half_width_px to +half_width_px along columns and rows,
//   X = x + u cos - v sin,  Y = y + u sin + v cos.
// One stage, unlike the two of the authors' code (design: same result but for their rounding and
// second blur). CheckError unless patch.size() == size * size, size >= 2 and the image has 2 x 2
// pixels.
void SamplePatch(const GrayImage& image, const PatchFrame& frame, int size, std::span<float> patch);
// The same, rounded to the nearest grey value.
void SamplePatch(const GrayImage& image, const PatchFrame& frame, int size,
                 std::span<std::uint8_t> patch);

// Whether the square, not turned, lies within the image: what a keypoint needs to be kept.
bool LiesWithin(const GrayImage& image, double x, double y, double half_width_px);

}  // namespace lift_slam
