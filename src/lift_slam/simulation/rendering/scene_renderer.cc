#include "lift_slam/simulation/rendering/scene_renderer.h"

#include <optional>

#include "lift_slam/simulation/rendering/downsampling.h"
#include "lift_slam/simulation/rendering/gl_context.h"
#include "lift_slam/simulation/rendering/render_target.h"
#include "lift_slam/simulation/rendering/scene_drawing.h"

namespace lift_slam {
namespace {

const RenderQuality& Checked(const RenderQuality& quality, const Camera& camera) {
  quality.Check();
  camera.Check();
  return quality;
}

}  // namespace

struct SceneRenderer::Implementation {
  Implementation(const Scene& scene, const Camera& camera_model,
                 const RenderQuality& render_quality)
      : camera(camera_model), quality(Checked(render_quality, camera_model)) {
    const GlContext::Scope scope(context);
    view.pinhole = SamplePinhole(camera.pinhole, quality.supersampling);
    drawing.emplace(scene, quality);
    target.emplace(view.pinhole.width, view.pinhole.height);
  }
  ~Implementation() {
    const GlContext::Scope scope(context);
    target.reset();
    drawing.reset();
  }

  Camera camera;
  RenderQuality quality;
  GlContext context;
  PinholeView view;
  std::optional<SceneDrawing> drawing;
  std::optional<RenderTarget> target;
  Samples samples;
};

SceneRenderer::SceneRenderer(const Scene& scene, const Camera& camera, const RenderQuality& quality)
    : implementation_(std::make_unique<Implementation>(scene, camera, quality)) {}

SceneRenderer::~SceneRenderer() = default;

RenderedView SceneRenderer::Render(const Rigid3d& cam_from_world) {
  Implementation& self = *implementation_;
  const GlContext::Scope scope(self.context);
  const PinholeIntrinsics& fine = self.view.pinhole;
  self.target->Begin(fine.width, fine.height);
  self.drawing->Draw(self.view,
                     {cam_from_world.RotationMatrix(), cam_from_world.TargetOriginInSource()});
  self.target->Read(self.samples);
  const PinholeIntrinsics& p = self.camera.pinhole;
  const int s = self.quality.supersampling;
  RenderedView result{p.width, p.height, DownsampleColor(self.samples.rgba, p, s), {}};
  const DepthRange range{self.quality.near_m, self.quality.far_m};
  result.depth_m.reserve(std::size_t(p.width) * std::size_t(p.height));
  for (int y = 0; y < p.height; ++y) {
    const float* row =
        self.samples.depth.data() + std::size_t(CenterSample(y, s)) * std::size_t(fine.width);
    for (int x = 0; x < p.width; ++x) {
      const float value = row[CenterSample(x, s)];
      result.depth_m.push_back(value > 0.0F ? 1.0F / range.InverseDepth(value) : 0.0F);
    }
  }
  return result;
}

}  // namespace lift_slam
