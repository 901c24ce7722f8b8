#include "lift_slam/simulation/scene/torcs_data.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lift_slam/util/environment.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/nearest_name.h"

namespace lift_slam {
namespace fs = std::filesystem;
namespace {

constexpr const char* kDebianFolder = "/usr/share/games/torcs";

std::vector<fs::path> Folders(const fs::path& parent) {
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(parent)) {
    if (entry.is_directory()) folders.push_back(entry.path());
  }
  std::sort(folders.begin(), folders.end());
  return folders;
}

std::string LastPart(const std::string& track) { return track.substr(track.find('/') + 1); }

}  // namespace

fs::path TorcsFolder(const std::string& folder) {
  const fs::path chosen = !folder.empty()
                              ? fs::path(folder)
                              : EnvironmentPath("LIFT_SLAM_TORCS").value_or(kDebianFolder);
  std::error_code ignored;
  if (!fs::is_directory(chosen / "tracks", ignored)) {
    throw InputError(fmt::format(
        "{}: no TORCS tracks here; install Debian's package torcs-data (tools/install_torcs_data), "
        "or name its folder by the environment variable LIFT_SLAM_TORCS",
        chosen.string()));
  }
  return chosen;
}

std::vector<std::string> ListTorcsTracks(const fs::path& torcs_folder) {
  std::vector<std::string> tracks;
  for (const fs::path& category : Folders(torcs_folder / "tracks")) {
    for (const fs::path& track : Folders(category)) {
      const std::string name = track.filename().string();
      if (fs::exists(track / (name + ".xml"))) {
        tracks.push_back(category.filename().string() + "/" + name);
      }
    }
  }
  return tracks;
}

fs::path FindTorcsTrack(const std::string& name, const fs::path& torcs_folder) {
  const std::vector<std::string> tracks = ListTorcsTracks(torcs_folder);
  std::vector<std::string> short_names;
  for (const std::string& track : tracks) {
    if (track == name || LastPart(track) == name) return torcs_folder / "tracks" / track;
    short_names.push_back(LastPart(track));
  }
  throw InputError(
      fmt::format("'{}' is neither a file nor a TORCS track (nearest: {}); known tracks: {}", name,
                  NearestName(LastPart(name), short_names), fmt::join(short_names, ", ")));
}

}  // namespace lift_slam
