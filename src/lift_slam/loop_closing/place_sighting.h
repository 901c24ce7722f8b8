#pragma once

#include <span>
#include <vector>

#include "lift_slam/map/map.h"

namespace lift_slam {

// What a camera sees of points that should be there.
struct Sighting {
  std::vector<MapPointId> points;  // by feature
  int num_visible = 0;             // that should be seen
  int num_found = 0;               // these that are

  double FoundRatio() const {
    return num_visible > 0 ? static_cast<double>(num_found) / num_visible : 0.0;
  }
};

struct SightingOptions {
  double search_radius_factor = 1.0;  // of the windows of local map tracking
  double max_squared_error = 0.0;     // of a feature from the projected point, in sigmas
};

// Looks for points of a map in a keyframe (of the same map or of another one) whose camera is at
// `cam_from_world` in the world of the points.
Sighting FindPoints(const Map& map, std::span<const MapPointId> points, const KeyFrame& keyframe,
                    const Rigid3d& cam_from_world, const SightingOptions& options);

}  // namespace lift_slam
