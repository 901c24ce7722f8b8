#include "lift_slam/simulation/rendering/scene_drawing.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lift_slam/simulation/rendering/shaders.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Eigen::Vector3f;

constexpr double kCellM = 64.0;  // small enough to cull well, few enough for cheap draw calls
constexpr unsigned int kBaseUnit = 0, kShadeUnit = 1;

GlProgram SurfaceProgram(const SurfaceShaderKind& kind) {
  return MakeGlProgram(SurfaceVertexShader(kind), SurfaceFragmentShader(kind));
}

int SkyWidth(const Scene& scene) {
  const int texture = scene.sky.texture;
  if (texture < -1 || texture >= static_cast<int>(scene.textures.size())) {
    throw InputError(fmt::format("the sky names texture {}, expected -1 to {}", texture,
                                 static_cast<int>(scene.textures.size()) - 1));
  }
  return texture < 0 ? 0 : scene.textures[static_cast<std::size_t>(texture)].width;
}

void SetVector(GlName program, int uniform, const Vector3f& value) {
  glProgramUniform3fv(program, uniform, 1, value.data());
}

// Drawing all triangles of a run of chunks with one call.
struct DrawCall {
  std::vector<GLsizei> counts;
  std::vector<const void*> offsets;

  void Add(const Chunk& chunk) {
    counts.push_back(static_cast<GLsizei>(chunk.index_count));
    offsets.push_back(reinterpret_cast<const void*>(std::uintptr_t{4} * chunk.first_index));
  }
  void Flush() {
    glMultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                        static_cast<GLsizei>(counts.size()));
    counts.clear();
    offsets.clear();
  }
};

}  // namespace

SceneDrawing::SceneDrawing(const Scene& scene, const RenderQuality& quality)
    : range_{quality.near_m, quality.far_m},
      light_(MakeDaylight(scene, quality)),
      sky_(scene.sky),
      sky_width_(SkyWidth(scene)),
      chunked_(MakeChunks(scene, light_.to_sun, kCellM)),
      textures_(scene),
      geometry_(chunked_) {
  const bool has_fog = light_.fog_density > 0.0F;
  for (unsigned int i = 0; i < programs_.size(); ++i) {
    programs_[i] = SurfaceProgram({.is_alpha_tested = (i & 1U) != 0,
                                   .has_shade = (i & 2U) != 0,
                                   .has_fog = has_fog,
                                   .anisotropy = quality.anisotropy});
  }
  sky_program_ = MakeGlProgram(SkyVertexShader(), SkyFragmentShader(has_fog));
}

void SceneDrawing::Draw(const PinholeView& view, const ViewPose& pose) const {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glFrontFace(GL_CW);  // row 0 is the top row: what is counter-clockwise appears clockwise
  SetFrameUniforms(view, pose);
  geometry_.Bind();
  DrawSurfaces(VisibleChunks(chunked_, view, pose, range_));
  DrawSky(view, pose);
}

void SceneDrawing::SetFrameUniforms(const PinholeView& view, const ViewPose& pose) const {
  const Eigen::Matrix4f clip = ClipFromEye(view, pose.cam_from_scene, range_).cast<float>();
  const Vector3f eye_high = pose.eye.cast<float>();
  const Vector3f eye_low = (pose.eye - eye_high.cast<double>()).cast<float>();
  for (const GlProgram& program : programs_) {
    glProgramUniformMatrix4fv(program.Name(), kClipFromEyeUniform, 1, GL_FALSE, clip.data());
    SetVector(program.Name(), kEyeHighUniform, eye_high);
    SetVector(program.Name(), kEyeLowUniform, eye_low);
    SetFogUniforms(program.Name(), view);
  }
}

void SceneDrawing::SetFogUniforms(GlName program, const PinholeView& view) const {
  if (light_.fog_density <= 0.0F) return;
  SetVector(program, kFogColorUniform, light_.fog_color);
  glProgramUniform1f(program, kFogDensityUniform, light_.fog_density);
  if (program == sky_program_.Name()) return;
  const PinholeIntrinsics& p = view.pinhole;  // gl_FragCoord is sample + 0.5
  const Eigen::Vector4d ray(1.0 / p.fx, 1.0 / p.fy, -(p.cx + 0.5) / p.fx, -(p.cy + 0.5) / p.fy);
  const Eigen::Vector4f values = ray.cast<float>();
  glProgramUniform4fv(program, kFogRayUniform, 1, values.data());
}

const GlProgram& SceneDrawing::ProgramOf(const Appearance& look) const {
  return programs_[(look.is_alpha_tested ? 1U : 0U) + (look.shade_texture >= 0 ? 2U : 0U)];
}

void SceneDrawing::UseAppearance(const Appearance& look) const {
  const GlName program = ProgramOf(look).Name();
  glUseProgram(program);
  const Vector3f constant = look.emission + look.ambient.cwiseProduct(light_.ambient);
  SetVector(program, kConstantLightUniform, constant);
  SetVector(program, kSunLightUniform, look.color.cwiseProduct(light_.diffuse));
  textures_.BindSurface(kBaseUnit, look.texture);
  if (look.shade_texture >= 0) textures_.BindSurface(kShadeUnit, look.shade_texture);
  if (look.double_sided) {
    glDisable(GL_CULL_FACE);
  } else {
    glEnable(GL_CULL_FACE);
  }
}

void SceneDrawing::DrawSurfaces(const std::vector<int>& chunks) const {
  DrawCall call;
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    const Chunk& chunk = chunked_.chunks[static_cast<std::size_t>(chunks[i])];
    call.Add(chunk);
    const bool is_last =
        i + 1 == chunks.size() ||
        chunked_.chunks[static_cast<std::size_t>(chunks[i + 1])].appearance != chunk.appearance;
    if (!is_last) continue;
    UseAppearance(chunked_.appearances[static_cast<std::size_t>(chunk.appearance)]);
    call.Flush();
  }
}

// Mip-map level at which a texel of the sky is as wide as a sample; negative without a picture.
float SceneDrawing::SkyLevel(const PinholeView& view) const {
  if (sky_width_ == 0) return -1.0F;
  const double texels_per_rad = sky_width_ * sky_.repeats / (2.0 * std::numbers::pi);
  return static_cast<float>(std::max(0.0, std::log2(texels_per_rad / view.pinhole.fx)));
}

void SceneDrawing::DrawSky(const PinholeView& view, const ViewPose& pose) const {
  const GlName program = sky_program_.Name();
  const Eigen::Matrix3f rays = SceneFromNdc(view, pose.cam_from_scene).cast<float>();
  glUseProgram(program);
  glProgramUniformMatrix3fv(program, kSceneFromNdcUniform, 1, GL_FALSE, rays.data());
  SetVector(program, kSkyColorUniform, sky_.color);
  SetVector(program, kSkyColorBelowUniform, sky_.color_below);
  SetVector(program, kSkyTintUniform, light_.sky_tint);
  const Eigen::Vector3d band(std::tan(sky_.bottom_elevation_rad), std::tan(sky_.top_elevation_rad),
                             sky_.repeats);
  SetVector(program, kSkyBandUniform, band.cast<float>());
  glProgramUniform1f(program, kSkyLevelUniform, SkyLevel(view));
  SetFogUniforms(program, view);
  textures_.BindSky(kBaseUnit, sky_.texture);
  glDisable(GL_CULL_FACE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lift_slam
