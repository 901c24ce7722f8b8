#pragma once

#include "lift_slam/simulation/scene/scene.h"
#include "lift_slam/simulation/scene/torcs_track.h"

namespace lift_slam {

// Sky and light of a track as TORCS draws them, appended to the scene. The background picture
// stands on a cylinder of radius 1 around the camera; its layout is the track's background type:
//   0  the picture four times around, from height -0.5 to 1
//   2  its lower and its upper half by turns, each a quarter around, from height -0.5 to 1
//   4  the picture once around, from height -1 to 1
// (TORCS mirrors 0 and 2; here they are not.) Transparent parts show the background colour, a
// black bottom the lowest colour above it. The picture fades into the colours above and below it at
// its rims.
// Throws InputError when the picture is missing or of another type.
void AddTorcsSky(const TorcsTrack& track, Scene& scene);

}  // namespace lift_slam
