#pragma once

#include <filesystem>

#include "lift_slam/simulation/scene/scene.h"
#include "lift_slam/simulation/scene/texture_set.h"

namespace lift_slam {

// Appends what assimp reads (glTF, GLB, OBJ, PLY, ...) as triangles with node transforms applied:
// base colour and texture (a file or embedded), normals of the file or computed. With y_is_up the
// axes are turned to the scene's z up: (x, -z, y). Units are taken as metres. Throws InputError
// with the file and assimp's own words when it cannot be read.
void AppendWithAssimp(const std::filesystem::path& file, bool y_is_up, TextureSet& textures,
                      Scene& scene);

}  // namespace lift_slam
