#pragma once

#include <Eigen/Core>

#include "lift_slam/simulation/rendering/scene_renderer.h"

namespace lift_slam {

// The light in which a scene is drawn; colours from 0 to 1 (and above).
struct Daylight {
  Eigen::Vector3f to_sun;  // unit length, scene frame
  Eigen::Vector3f ambient;
  Eigen::Vector3f diffuse;
  Eigen::Vector3f sky_tint;  // multiplies the sky's picture and colour
  Eigen::Vector3f fog_color;
  float fog_density;  // 1 / m; 0: no fog
};

// The scene's own light, or that of a sun at the quality's elevation: redder and weaker the
// longer its way through the air, with a bluish twilight until 12 degrees below the horizon.
Daylight MakeDaylight(const Scene& scene, const RenderQuality& quality);

}  // namespace lift_slam
