#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "lift_slam/simulation/scene/scene.h"

namespace lift_slam {

// A vertex as the vertex shader reads it.
struct DrawVertex {
  float position[3];
  float uv[2];        // v DOWN (0: first row of the picture)
  float shade_uv[2];  // likewise
  float sun_cosine;   // between normal and sun; the back side sees its negative
};
static_assert(sizeof(DrawVertex) == 32);

// How a surface looks: the state of a draw call.
struct Appearance {
  int texture = -1;
  int shade_texture = -1;
  bool is_alpha_tested = false;
  bool double_sided = true;
  Eigen::Vector3f color, emission, ambient;

  bool operator==(const Appearance&) const = default;
};

// Triangles of one appearance that lie close together: what is drawn or skipped as a whole.
struct Chunk {
  int appearance = 0;
  Eigen::AlignedBox3f box;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
};

// A scene in the order in which it is drawn.
struct ChunkedScene {
  std::vector<Appearance> appearances;
  std::vector<Chunk> chunks;
  std::vector<DrawVertex> vertices;
  std::vector<std::uint32_t> indices;
};

// Sorts all triangles into chunks of `cell_m` edge length (in x and y). Degenerate triangles are
// left out. Triangles of double-sided meshes are turned so that their front, counter-clockwise,
// is the side of their normals. Throws InputError naming the mesh when an index, a texture or a
// vertex is not valid.
ChunkedScene MakeChunks(const Scene& scene, const Eigen::Vector3f& to_sun, double cell_m);

}  // namespace lift_slam
