#pragma once

#include "lift_slam/map/map.h"

namespace lift_slam {

// Places features to a fraction of a pixel where their points are seen: a feature found again lies
// on the pixel grid of its level and lags behind its motion, so its pixel is replaced by the one
// at which the point's patch fits best (AlignPatch). All observations of a point are aligned to the
// same patch, that of its anchor: errors do not add up from frame to frame. Everything here does
// nothing where an image is missing (alignment off, or let go with age).

// Makes the keyframe's feature the anchor of a point that it sees.
void AnchorPoint(MapPointId point, KeyFrameId keyframe, Map& map);

// Aligns the keyframe's observation of the point; the detected pixel stays where that fails.
// Returns whether it was aligned.
bool AlignObservation(MapPointId point, KeyFrameId keyframe, Map& map);

// Aligns all matches of a frame whose pose is nearly right; returns how many were aligned.
int AlignMatches(const Map& map, Frame& frame);

}  // namespace lift_slam
