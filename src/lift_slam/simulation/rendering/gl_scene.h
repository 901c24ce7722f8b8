#pragma once

#include <vector>

#include "lift_slam/simulation/rendering/daylight.h"
#include "lift_slam/simulation/rendering/gl_objects.h"
#include "lift_slam/simulation/rendering/scene_chunks.h"

namespace lift_slam {

// Textures of a scene in OpenGL's hands.
class GlTextures {
 public:
  explicit GlTextures(const Scene& scene);

  // `index` as in the scene; -1 binds plain white.
  void BindSurface(unsigned int unit, int index) const;
  void BindSky(unsigned int unit, int index) const;

 private:
  void Bind(unsigned int unit, int index) const;

  std::vector<GlTexture> textures_;  // the scene's, then white
  GlSampler surface_, sky_;          // repeated both ways; to the sides only
};

// Vertices and indices of a chunked scene in OpenGL's hands.
class GlGeometry {
 public:
  explicit GlGeometry(const ChunkedScene& scene);

  void Bind() const;

 private:
  GlVertexArray layout_;
  GlBuffer vertices_, indices_;
};

}  // namespace lift_slam
