#pragma once

#include "lift_slam/features/orb/fast_corners.h"
#include "lift_slam/features/orb/orb_options.h"
#include "lift_slam/image/image.h"

namespace lift_slam {

// A position below the pixel, in pixels of the level.
struct RefinedPosition {
  float x = 0.0F, y = 0.0F;
};

// The peak of a parabola through the scores of the corner and its neighbours, in x and in y, at
// most half a pixel from the corner. The score is the FAST score, or the smaller eigenvalue of the
// structure tensor over 7 x 7 pixels (Shi and Tomasi, 1994).
RefinedPosition RefineCorner(const GrayImage& image, const FastScoreMap& scores,
                             const Corner& corner, SubpixelMethod method);

}  // namespace lift_slam
