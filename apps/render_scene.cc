#include "apps/render_scene.h"

#include <fmt/format.h>

#include "lift_slam/simulation/scene/torcs_data.h"
#include "lift_slam/simulation/scene/torcs_road.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {

RenderScene LoadRenderScene(const std::string& name, const SceneLoaderOptions& options) {
  LoadedScene loaded = LoadScene(name, options);
  RenderScene result;
  result.file = loaded.track ? loaded.track->mesh : std::filesystem::path(name);
  result.sha256 = Sha256Hex(ReadText(result.file));
  result.warnings = std::move(loaded.warnings);
  result.scene = std::move(loaded.scene);
  if (!loaded.track) {
    result.no_road = "only the tracks of TORCS have one";
    return result;
  }
  try {
    result.road = FindTorcsRoad(result.scene);
  } catch (const InputError& error) {
    // Recorded poses do not need it.
    result.no_road = error.what();
  }
  return result;
}

std::string TrackList(const SceneLoaderOptions& options) {
  const std::filesystem::path folder = TorcsFolder(options.torcs_folder);
  std::string text;
  for (const std::string& name : ListTorcsTracks(folder)) {
    const TorcsTrack track = ReadTorcsTrack(FindTorcsTrack(name, folder));
    text += fmt::format("{:20} {}\n", name, track.title);
  }
  return text;
}

}  // namespace lift_slam
