#pragma once

#include <filesystem>
#include <string_view>

#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// Decodes a Silicon Graphics image (.rgb, .rgba, .bw, .sgi): 1 to 4 channels (grey, grey with
// alpha, RGB, RGBA), 8 or 16 bits, verbatim or run-length coded. 16 bits keep their high byte.
// `path` is for messages alone. Throws InputError when the data is no such picture or is cut off.
// Source: "The SGI Image File Format", version 1.00, Paul Haeberli, Silicon Graphics.
SceneTexture DecodeSgiImage(std::string_view bytes, const std::filesystem::path& path);

}  // namespace lift_slam
