#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/simulation/scene/scene.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct RenderedView {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // height x width x 3, row 0 at the top
  std::vector<float> depth_m;     // height x width, z in the camera frame; 0: nothing there (sky)
};

// How pixels are made; nothing of the camera's motion.
struct RenderQuality {
  int supersampling = 2;          // samples a pixel and direction
  int anisotropy = 8;             // of the texture filter
  double near_m = 0.1;            // nothing nearer is seen
  double far_m = 3000.0;          // nothing farther is seen
  double fog_visibility_m = 0.0;  // distance at which 5 % of the contrast is left; 0: no fog
  // Time of day: the sun's direction and the colours of its light; the scene's own when false.
  bool own_sun = false;
  double sun_elevation_deg = 45.0;
  double sun_azimuth_deg = 0.0;  // from x towards y
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

// Draws a scene as a camera sees it: exact camera model (any distortion), anti-aliased. Depth is
// that of the pixel's centre. Not thread-safe, but any number of renderers may work side by side,
// each in its own thread (see RecommendedRendererThreads). The same scene, camera, quality and
// pose give the same bytes, in whichever renderer and thread.
class SceneRenderer {
 public:
  // The scene is copied to OpenGL: it need not outlive the renderer. Throws InputError when no
  // OpenGL context can be had, or an option, the camera or the scene is not valid.
  SceneRenderer(const Scene& scene, const Camera& camera, const RenderQuality& quality);
  ~SceneRenderer();
  SceneRenderer(const SceneRenderer&) = delete;
  SceneRenderer& operator=(const SceneRenderer&) = delete;

  // May be called from another thread than the constructor, but not from two at once.
  RenderedView Render(const Rigid3d& cam_from_world);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

// How many renderers, each in a thread of its own, draw most pictures a second. The software
// renderer has its own threads for filling triangles; a second renderer keeps them busy while the
// first prepares triangles or averages samples.
int RecommendedRendererThreads();

}  // namespace lift_slam
