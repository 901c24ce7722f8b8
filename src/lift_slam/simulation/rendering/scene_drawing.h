#pragma once

#include <array>
#include <map>
#include <memory>

#include "lift_slam/simulation/rendering/culling.h"
#include "lift_slam/simulation/rendering/daylight.h"
#include "lift_slam/simulation/rendering/gl_scene.h"
#include "lift_slam/simulation/rendering/pinhole_view.h"

namespace lift_slam {

// Draws a scene into the bound frame buffer (RenderTarget::Begin). Needs the current context in
// which it was made.
class SceneDrawing {
 public:
  SceneDrawing(const Scene& scene, const RenderQuality& quality);

  void Draw(const PinholeView& view, const ViewPose& pose) const;

 private:
  // Programs by is_alpha_tested + 2 has_shade.
  using SurfacePrograms = std::array<GlProgram, 4>;

  void SetFrameUniforms(const PinholeView& view, const ViewPose& pose) const;
  void SetFogUniforms(GlName program, const PinholeView& view) const;
  void DrawSurfaces(const std::vector<int>& chunks) const;
  void UseAppearance(const Appearance& look) const;
  void DrawSky(const PinholeView& view, const ViewPose& pose) const;
  const GlProgram& ProgramOf(const Appearance& look) const;
  float SkyLevel(const PinholeView& view) const;

  DepthRange range_;
  Daylight light_;
  SceneSky sky_;
  int sky_width_ = 0;  // of its picture; 0: none
  ChunkedScene chunked_;
  GlTextures textures_;
  GlGeometry geometry_;
  SurfacePrograms programs_;
  GlProgram sky_program_;
};

}  // namespace lift_slam
