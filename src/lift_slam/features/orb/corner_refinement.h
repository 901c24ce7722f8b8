#pragma once

#include "lift_slam/features/orb/fast_corners.h"

namespace lift_slam {

// A position below the pixel, in pixels of the level.
struct RefinedPosition {
  float x = 0.0F, y = 0.0F;
};

// The peak of the quadratic surface that fits the FAST scores of the corner and its 8 neighbours
// best, at most half a pixel from the corner in x and in y; the corner itself when the surface has
// no peak.
RefinedPosition RefineCorner(const FastScoreMap& scores, const Corner& corner);

}  // namespace lift_slam
