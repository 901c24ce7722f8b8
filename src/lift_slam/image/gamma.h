#pragma once

#include "lift_slam/image/image.h"

namespace lift_slam {

// Every grey value v becomes 255 (v / 255)^gamma, rounded: below 1 brighter, above 1 darker.
// CheckError unless gamma is positive.
GrayImage ApplyGamma(const GrayImage& image, double gamma);

}  // namespace lift_slam
