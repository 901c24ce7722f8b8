#pragma once

#include <span>
#include <string>

#include "lift_slam/image/image.h"

namespace lift_slam {

struct LabelledImage {
  std::string label;
  GrayImage image;
};

// Images side by side in rows, each below its label, as the bytes of a PNG file. Every image is
// scaled to the same width. CheckError without images or with an empty one.
std::string ContactSheet(std::span<const LabelledImage> images, int num_columns);

// One image as the bytes of a PNG file.
std::string EncodePng(const GrayImage& image);

}  // namespace lift_slam
