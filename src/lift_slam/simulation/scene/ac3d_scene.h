#pragma once

#include "lift_slam/simulation/scene/ac3d_reader.h"
#include "lift_slam/simulation/scene/scene.h"
#include "lift_slam/simulation/scene/texture_set.h"

namespace lift_slam {

// Appends the model's surfaces as triangles: a mesh for each object, material and sidedness, under
// the object's name, vertices in the order of their first use. Normals come from the file or, in
// plain AC3D files, from the faces around a vertex that meet at less than the crease angle.
void AppendAc3d(const Ac3dModel& model, TextureSet& textures, Scene& scene);

}  // namespace lift_slam
