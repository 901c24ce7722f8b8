#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/simulation/rendering/scene_renderer.h"

namespace lift_slam {

enum class ImageColor { kGray, kRgb };

// An image of 8-bit values, channels interleaved, row 0 at the top.
struct ByteImage {
  int width = 0, height = 0, channels = 1;  // 1: grey, 3: RGB
  std::vector<std::uint8_t> values;
};

// The light that falls on each pixel; 1 is white at the usual exposure. Channels interleaved.
struct LightImage {
  int width = 0, height = 0, channels = 1;
  std::vector<float> values;
};

// Tone curve that the pictures of a scene are made for.
inline constexpr double kSceneGamma = 2.2;

// The picture as it is: its RGB, or its grey by the usual weights (BT.601).
ByteImage ToBytes(const RenderedView& view, ImageColor color);

// (value / 255) ^ kSceneGamma.
LightImage ToLight(const ByteImage& image);

// sum += weight * image, in the rows from `first_row` up to, not including, `end_row`. An empty
// sum becomes black first.
void AddLight(const LightImage& image, float weight, int first_row, int end_row, LightImage& sum);

// 255 * light ^ (1 / gamma), rounded; light beyond white is cut off.
ByteImage Develop(const LightImage& image, double gamma);

}  // namespace lift_slam
