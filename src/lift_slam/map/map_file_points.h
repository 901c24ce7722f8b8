#pragma once

#include <memory>
#include <span>
#include <vector>

#include "lift_slam/map/map_file.h"
#include "lift_slam/map/map_file_records.h"

namespace lift_slam {

// Map points with observations, appearance and patch.
RecordBytes PointsRecord(std::span<const MapPointId> ids, const MapToStore& stored);
// Puts the points of a record at their ids, which are below num_ids and of no point before;
// `points` grows as far as it must.
void TakePoints(MapRecordReader& reader, const DescriptorKind& features, std::size_t num_ids,
                std::vector<std::unique_ptr<MapPoint>>& points, std::vector<std::uint8_t>& gray);

}  // namespace lift_slam
