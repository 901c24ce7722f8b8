#pragma once

#include <optional>

#include "lift_slam/map/map.h"

namespace lift_slam {

// Where and how a camera would see a map point.
struct PointProjection {
  Eigen::Vector2d pixel;      // undistorted
  int level = 0;              // pyramid level at which it should be found
  double viewing_cosine = 1;  // between the viewing ray and the point's mean viewing direction
};

// Nothing when the point is behind the camera, outside the image, out of the pyramid's range of
// distances or seen from more than 60 degrees off its usual direction.
std::optional<PointProjection> ProjectPoint(const ViewModel& view, const MapPoint& point,
                                            const Rigid3d& cam_from_world);

}  // namespace lift_slam
