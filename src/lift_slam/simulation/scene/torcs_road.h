#pragma once

#include "lift_slam/simulation/scene/road.h"
#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// The road of a TORCS track, from its meshes named TKMN<number>: their ladders of quadrilaterals
// are joined where end rungs meet, and the longest loop is taken (other meshes of that name are
// bridges and walls). It starts at the smallest number, which is the start line, and runs the way
// the numbers grow, which is how TORCS drives. Two ends that one other mesh spans (a start line
// painted on a mesh of its own) are joined too. Throws InputError, naming the scene, when there is
// no road or the longest chain has a gap of more than 1 m, with the place.
Road FindTorcsRoad(const Scene& scene);

}  // namespace lift_slam
