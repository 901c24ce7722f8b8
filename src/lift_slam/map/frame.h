#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/image/pyramid.h"
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
  // The image, for the alignment of patches; null: none.
  std::shared_ptr<const ImagePyramid> pyramid;
  // By feature: undistorted pixel at which the matched point was found by alignment; nothing where
  // it was not, empty when no feature was aligned. Belongs to the present match.
  std::vector<std::optional<Eigen::Vector2f>> aligned_pixels;

  Frame() = default;
  Frame(std::int64_t index, std::int64_t time_ns, std::shared_ptr<const FrameFeatures> f)
      : frame_index(index),
        timestamp_ns(time_ns),
        features(std::move(f)),
        map_points(static_cast<std::size_t>(features->size())) {}

  void ClearMatches() {
    map_points.assign(map_points.size(), MapPointId());
    aligned_pixels.clear();
  }
  std::optional<Eigen::Vector2f> AlignedPixel(int feature) const {
    if (aligned_pixels.empty()) return std::nullopt;
    return aligned_pixels[static_cast<std::size_t>(feature)];
  }
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
  std::vector<MapPointId> map_points;           // by feature; invalid id: none
  std::shared_ptr<const ImagePyramid> pyramid;  // null: none, or let go with age
  // Of an earlier run, whose frame_index and timestamp_ns it has.
  bool is_loaded = false;

  Eigen::Vector3d Center() const { return cam_from_world.TargetOriginInSource(); }
};

}  // namespace lift_slam
