#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lift_slam/testing/texture.h"

namespace lift_slam {

// A rectangle in the world: corner + a * edge_u + b * edge_v, a and b in [0, 1], edges
// perpendicular. Seen from both sides.
struct TexturedQuad {
  Eigen::Vector3d corner, edge_u, edge_v;  // metres
  int texture = 0;                         // index into TexturedWorld::textures
  double texels_per_metre = 100.0;
  Eigen::Vector2d offset_texels = Eigen::Vector2d::Zero();  // texture place of the corner
  double brightness = 1.0;                                  // factor on the texture's grey
};

struct TexturedWorld {
  std::vector<Texture> textures;
  std::vector<TexturedQuad> quads;
};

// A room of 8 x 3 x 6 metres around the origin with furniture (boxes); y points down.
TexturedWorld MakeRoom(std::uint64_t seed);
// A street along WorldFromStreet (camera_path.h): houses, parked cars, poles, lane marks; the
// ground lies 1.65 m below the line, as below a car's camera.
TexturedWorld MakeStreet(std::uint64_t seed);

}  // namespace lift_slam
