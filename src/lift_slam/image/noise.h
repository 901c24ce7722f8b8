#pragma once

#include "lift_slam/image/image.h"
#include "lift_slam/util/random.h"

namespace lift_slam {

// Normal noise added to every pixel, rounded, within 0 to 255.
GrayImage AddNoise(const GrayImage& image, double sigma_grey, Random& random);

}  // namespace lift_slam
