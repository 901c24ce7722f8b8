#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>

namespace lift_slam {

// What a track's own description (NAME.xml) says.
struct TorcsTrack {
  std::string name;      // of its folder: "dirt-3"
  std::string category;  // "dirt", "road", "oval"
  std::string title;     // "Dirt 3"
  std::string author;
  std::string description;
  std::filesystem::path folder;
  std::filesystem::path mesh;      // .acc or .ac
  std::string background_picture;  // file name; empty: none
  int background_type = 0;         // layout of that picture: 0, 2 or 4 (torcs_sky.h)
  Eigen::Vector3f background_color = {0.0F, 0.0F, 0.1F};
  Eigen::Vector3f ambient = {0.2F, 0.2F, 0.2F};
  Eigen::Vector3f diffuse = {0.8F, 0.8F, 0.8F};
  Eigen::Vector3f light_position = {0.0F, 0.0F, 200.0F};  // infinitely far in that direction
};

// Reads FOLDER/NAME.xml, NAME being the folder's own name. Entities and the external document type
// are skipped. Throws InputError when the file is missing, no XML, names no mesh, or a value is no
// number.
TorcsTrack ReadTorcsTrack(const std::filesystem::path& folder);

}  // namespace lift_slam
