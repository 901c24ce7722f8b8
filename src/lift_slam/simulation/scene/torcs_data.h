#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lift_slam {

// Where the data of the racing game TORCS lie: `folder` when not empty, else the environment
// variable LIFT_SLAM_TORCS, else /usr/share/games/torcs, where Debian's package torcs-data puts
// them. Throws InputError that names the package when there are no tracks.
std::filesystem::path TorcsFolder(const std::string& folder);

// The tracks there as "category/name" ("dirt/dirt-3"), in alphabetical order.
std::vector<std::string> ListTorcsTracks(const std::filesystem::path& torcs_folder);

// The folder of a track by "name" or "category/name". Throws InputError that lists the known tracks
// and names the nearest when there is none.
std::filesystem::path FindTorcsTrack(const std::string& name,
                                     const std::filesystem::path& torcs_folder);

}  // namespace lift_slam
