#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lift_slam/simulation/scene/scene.h"
#include "lift_slam/simulation/scene/torcs_track.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Which axis of the file points up. The scene's is z.
enum class UpAxis { kY, kZ };

struct SceneLoaderOptions {
  // Empty: the environment variable LIFT_SLAM_TORCS, else where Debian's torcs-data puts them.
  std::string torcs_folder;
  UpAxis up_axis = UpAxis::kY;  // of glTF, OBJ and the like; glTF says y, most OBJ files keep to it

  void Visit(OptionVisitor& visitor) {
    static constexpr std::string_view kUpAxisNames[] = {"y", "z"};
    visitor.Field("torcs_folder", torcs_folder,
                  "data of TORCS; empty: LIFT_SLAM_TORCS, else /usr/share/games/torcs");
    visitor.Field("up_axis", up_axis, kUpAxisNames, "axis of a glTF or OBJ file that points up");
  }
};

struct LoadedScene {
  Scene scene;
  std::optional<TorcsTrack> track;    // a TORCS track's own description
  std::vector<std::string> warnings;  // a line each: missing textures
};

// A TORCS track by name ("dirt-3", "dirt/dirt-3"), by its folder or its mesh file; any other .ac or
// .acc file; and what assimp reads (glTF, GLB, OBJ, ...). Throws InputError: unknown track (lists
// the known ones), no TORCS data, unreadable or malformed file, a mesh without textures.
LoadedScene LoadScene(const std::string& track_or_file, const SceneLoaderOptions& options = {});

}  // namespace lift_slam
