#include "lift_slam/simulation/rendering/scene_renderer.h"

#include <algorithm>
#include <optional>

#include "lift_slam/simulation/rendering/downsampling.h"
#include "lift_slam/simulation/rendering/gl_context.h"
#include "lift_slam/simulation/rendering/lens_map.h"
#include "lift_slam/simulation/rendering/lens_resampling.h"
#include "lift_slam/simulation/rendering/render_target.h"
#include "lift_slam/simulation/rendering/scene_drawing.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam {
namespace {

// What is made of a camera before anything is drawn.
struct ViewPlan {
  PinholeIntrinsics pinhole;
  std::optional<LensMap> lens;  // nothing: the camera is itself a pinhole
  std::vector<PinholeView> views;

  int MaxWidth() const {
    int width = 0;
    for (const PinholeView& view : views) width = std::max(width, view.pinhole.width);
    return width;
  }
  int MaxHeight() const {
    int height = 0;
    for (const PinholeView& view : views) height = std::max(height, view.pinhole.height);
    return height;
  }
};

ViewPlan MakePlan(const Camera& camera, const RenderQuality& quality) {
  quality.Check();
  camera.Check();
  ViewPlan plan;
  plan.pinhole = camera.pinhole;
  if (camera.HasDistortion()) {
    plan.lens = MakeLensMap(camera, quality.supersampling);
    plan.views = plan.lens->views;
  } else {
    plan.views = {{SamplePinhole(camera.pinhole, quality.supersampling)}};
  }
  return plan;
}

// What lives in a context.
struct Drawing {
  Drawing(const ViewPlan& plan, const Scene& scene_to_draw, const RenderQuality& quality)
      : target(plan.MaxWidth(), plan.MaxHeight()), scene(scene_to_draw, quality) {}

  RenderTarget target;
  SceneDrawing scene;
};

}  // namespace

struct SceneRenderer::Implementation {
  Implementation(const Scene& scene, const Camera& camera, const RenderQuality& render_quality)
      : quality(render_quality), plan(MakePlan(camera, quality)), samples(plan.views.size()) {
    const GlContext::Scope scope(context);
    drawing.emplace(plan, scene, quality);
  }
  ~Implementation() {
    const GlContext::Scope scope(context);
    drawing.reset();
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void DrawViews(const ViewPose& pose);
  RenderedView Develop() const;

  RenderQuality quality;
  ViewPlan plan;
  std::vector<Samples> samples;  // of the plan's views
  GlContext context;
  std::optional<Drawing> drawing;  // made and destroyed with the context current
};

void SceneRenderer::Implementation::DrawViews(const ViewPose& pose) {
  const GlContext::Scope scope(context);
  for (std::size_t i = 0; i < plan.views.size(); ++i) {
    const PinholeView& view = plan.views[i];
    drawing->target.Begin(view.pinhole.width, view.pinhole.height);
    drawing->scene.Draw(view, pose);
    drawing->target.Read(samples[i]);
  }
}

RenderedView SceneRenderer::Implementation::Develop() const {
  const PinholeIntrinsics& p = plan.pinhole;
  const DepthRange range{quality.near_m, quality.far_m};
  if (plan.lens) {
    return {p.width, p.height, ResampleColor(*plan.lens, samples),
            ResampleDepth(*plan.lens, samples, range)};
  }
  return {p.width, p.height, DownsampleColor(samples[0].rgba, p, quality.supersampling),
          CenterDepth(samples[0].depth, p, quality.supersampling, range)};
}

SceneRenderer::SceneRenderer(const Scene& scene, const Camera& camera, const RenderQuality& quality)
    : implementation_(std::make_unique<Implementation>(scene, camera, quality)) {}

SceneRenderer::~SceneRenderer() = default;

RenderedView SceneRenderer::Render(const Rigid3d& cam_from_world) {
  implementation_->DrawViews(
      {cam_from_world.RotationMatrix(), cam_from_world.TargetOriginInSource()});
  return implementation_->Develop();
}

int RecommendedRendererThreads() { return std::min(NumHardwareThreads(), 2); }

}  // namespace lift_slam
