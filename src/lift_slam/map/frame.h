#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/map/frame_features.h"
#include "lift_slam/map/ids.h"

namespace lift_slam {

// One image on its way through tracking.
struct Frame {
  std::int64_t frame_index = -1;  // in the source sequence
  std::int64_t timestamp_ns = 0;
  std::shared_ptr<const FrameFeatures> features;
  Rigid3d cam_from_world;              // valid once tracked
  std::vector<MapPointId> map_points;  // by feature; invalid id: no match

  Frame() = default;
  Frame(std::int64_t index, std::int64_t time_ns, std::shared_ptr<const FrameFeatures> f)
      : frame_index(index),
        timestamp_ns(time_ns),
        features(std::move(f)),
        map_points(static_cast<std::size_t>(features->size())) {}

  int CountMatches() const {
    int n = 0;
    for (const MapPointId id : map_points) n += id.valid() ? 1 : 0;
    return n;
  }
};

// A frame kept in the map. Its map_points and the points' observations agree at all times: only
// Map changes them.
struct KeyFrame {
  KeyFrameId id;
  std::int64_t frame_index = -1;
  std::int64_t timestamp_ns = 0;
  std::shared_ptr<const FrameFeatures> features;
  Rigid3d cam_from_world;
  std::vector<MapPointId> map_points;  // by feature; invalid id: none

  Eigen::Vector3d Center() const { return cam_from_world.TargetOriginInSource(); }
};

}  // namespace lift_slam
