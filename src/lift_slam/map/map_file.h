#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "lift_slam/map/map.h"

namespace lift_slam {

// What the maps of a file were made with.
struct MapFileInfo {
  DescriptorKind features;  // of LIFT with the weights' hash
  PinholeIntrinsics pinhole;
  Eigen::Vector4d min_max_x_y = Eigen::Vector4d::Zero();  // see ViewModel
  ScaleLevels levels;
  std::uint64_t vocabulary_checksum = 0;  // 0: none
};

MapFileInfo MakeMapFileInfo(const ViewModel& view, const DescriptorKind& features,
                            std::uint64_t vocabulary_checksum);

using KeyFramePair = std::pair<KeyFrameId, KeyFrameId>;

// One map with what a run knows of it besides.
struct StoredMap {
  std::unique_ptr<Map> map;
  std::vector<std::uint8_t> gray_of_point;  // by point id, for display; may end early
  std::vector<KeyFramePair> loops;          // query and candidate of loops closed
};

struct MapToStore {
  const Map& map;
  const std::vector<std::uint8_t>& gray_of_point;
  std::vector<KeyFramePair> loops;
};

// Writes maps as a file that appears whole or not at all; docs/maps.md has its layout. The same
// bytes for the same maps. Throws InputError when the file cannot be written.
void WriteMapFile(const std::filesystem::path& path, const MapFileInfo& info,
                  const std::vector<MapToStore>& maps);

struct MapFile {
  MapFileInfo info;
  std::vector<StoredMap> maps;
};

// Reads the maps again, just as they were but for the keyframes' images; keyframes are marked
// `is_loaded`. `view` and `features` are those of the run that takes them over. Throws InputError
// for a file that is missing, foreign, of another version, truncated or damaged, or whose maps were
// made with another camera or other features.
MapFile ReadMapFile(const std::filesystem::path& path, std::shared_ptr<const ViewModel> view,
                    const DescriptorKind& features);

}  // namespace lift_slam
