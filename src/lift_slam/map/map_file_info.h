#pragma once

#include "lift_slam/map/map_file.h"
#include "lift_slam/map/map_file_records.h"

namespace lift_slam {

// The first record of a map file.
RecordBytes InfoRecord(const MapFileInfo& info, std::size_t num_maps);
struct InfoContents {
  MapFileInfo info;
  std::size_t num_maps = 0;
};
InfoContents TakeInfo(MapRecordReader& reader);

// Fails when the maps are of another camera or other features than `expected`.
void CheckInfo(const MapFileInfo& info, const MapFileInfo& expected, const MapRecordReader& reader);

}  // namespace lift_slam
