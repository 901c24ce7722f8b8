#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/simulation/scene/road.h"
#include "lift_slam/simulation/scene/scene_loader.h"

namespace lift_slam {

// A scene with all that the program tells about it.
struct RenderScene {
  Scene scene;
  std::filesystem::path file;  // that it was read from
  std::string sha256;          // of that file
  std::optional<Road> road;
  std::string no_road;  // why there is none; empty when there is one
  std::vector<std::string> warnings;
};

// A track or a file. Throws InputError as LoadScene does.
RenderScene LoadRenderScene(const std::string& name, const SceneLoaderOptions& options);

// "road/alpine-2  Alpine 2" for every track of TORCS, a line each. Throws InputError when the data
// are not there.
std::string TrackList(const SceneLoaderOptions& options);

}  // namespace lift_slam
