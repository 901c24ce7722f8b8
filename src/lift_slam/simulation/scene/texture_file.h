#pragma once

#include <filesystem>
#include <string_view>

#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// Alpha below this is a hole: the cut of the renderer's alpha test, 0 to 255.
inline constexpr int kAlphaCut = 128;

// A picture file of any kind that OpenCV reads (PNG, JPEG, ...) or Silicon Graphics' .rgb, told by
// its content. has_alpha is set when some pixel's alpha is below kAlphaCut. Throws InputError when
// the file is missing or no picture.
SceneTexture ReadTextureFile(const std::filesystem::path& path);

// The same from memory; `path` names it in messages.
SceneTexture DecodeTexture(std::string_view bytes, const std::filesystem::path& path);

}  // namespace lift_slam
