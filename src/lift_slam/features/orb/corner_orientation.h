#pragma once

#include "lift_slam/image/image.h"

namespace lift_slam {

// Half the side of the patch that orientation looks at, pixels.
inline constexpr int kOrientationRadius = 15;

// Direction from (x, y) to the centroid of the grey values in the disc of 31 pixels across (Rosin;
// ORB paper, sec. 3.2), radians in (-pi, pi], x right, y down; 0 for a patch without direction.
// (x, y) must be at least kOrientationRadius + 1 from the edge.
float IntensityCentroidAngle(const GrayImage& image, int x, int y);

}  // namespace lift_slam
