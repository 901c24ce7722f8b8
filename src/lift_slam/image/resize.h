#pragma once

#include "lift_slam/image/image.h"

namespace lift_slam {

// Resampled bilinearly, without smoothing, with the image borders aligned: pixel x of the result
// lies at (x + 0.5) * image.width() / width - 0.5. Sizes are positive, the image is not empty.
GrayImage Resize(const GrayImage& image, int width, int height);

// The same, written over `memory` where that has the size and nobody else holds it.
void ResizeInto(const GrayImage& image, int width, int height, GrayImage& memory);

}  // namespace lift_slam
