#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

struct TextureLevel {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;  // row 0 at the top
};

// The mip-map levels of a texture, the texture itself first, halved (rounded down) to 1 x 1.
// With alpha: colours are averaged over what is opaque and spread into what is not (no fringes
// of hidden colour), and each level's alpha is scaled so that as large a share of it passes the
// test alpha >= 0.5 as of the first: trees keep their leaves in the distance.
// Throws InputError when the size is not positive or does not fit the data.
std::vector<TextureLevel> MakeTexturePyramid(const SceneTexture& texture);

// Share of the texels with alpha >= 0.5.
double AlphaCoverage(const TextureLevel& level);

}  // namespace lift_slam
