#include "lift_slam/simulation/rendering/shaders.h"

#include <fmt/format.h>

namespace lift_slam {
namespace {

std::string Header(const SurfaceShaderKind& kind) {
  const bool is_anisotropic = kind.anisotropy > 1 && !kind.is_alpha_tested;
  return fmt::format(
      "#version 450 core\n{}{}{}{}", kind.is_alpha_tested ? "#define ALPHA_TESTED\n" : "",
      kind.has_shade ? "#define SHADED\n" : "", kind.has_fog ? "#define FOGGY\n" : "",
      is_anisotropic ? fmt::format("#define ANISOTROPIC {}\n", kind.anisotropy) : "");
}

constexpr const char* kSurfaceVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 uvs;
layout(location = 2) in float sun_cosine;
layout(location = 0) uniform mat4 clip_from_eye;
layout(location = 1) uniform vec3 eye_high;
layout(location = 2) uniform vec3 eye_low;
out vec2 uv;
out float sun;
#ifdef SHADED
out vec2 shade_uv;
#endif
void main() {
  precise vec3 near_by = position - eye_high;
  precise vec3 from_eye = near_by - eye_low;
  gl_Position = clip_from_eye * vec4(from_eye, 1.0);
  uv = uvs.xy;
  sun = sun_cosine;
#ifdef SHADED
  shade_uv = uvs.zw;
#endif
}
)";

// The light is limited to 1 before the texture, as in fixed-function OpenGL, for which these
// scenes were made.
constexpr const char* kSurfaceFragment = R"(
layout(location = 3) uniform vec3 constant_light;
layout(location = 4) uniform vec3 sun_light;
layout(binding = 0) uniform sampler2D base;
in vec2 uv;
in float sun;
#ifdef ANISOTROPIC
// The texels under a sample form an ellipse: as many taps along its long axis as it is longer
// than wide, each as wide as the short one. (llvmpipe's own filter is five times as slow.)
vec4 Texel() {
  vec2 size = vec2(textureSize(base, 0));
  vec2 across = dFdx(uv);
  vec2 down = dFdy(uv);
  vec2 across_texels = across * size;
  vec2 down_texels = down * size;
  float across_length = dot(across_texels, across_texels);
  float down_length = dot(down_texels, down_texels);
  float longer = sqrt(max(max(across_length, down_length), 1e-12));
  float area = abs(across_texels.x * down_texels.y - across_texels.y * down_texels.x);
  // Magnified texels need no more than one tap.
  float shorter = max(area / longer, min(1.0, longer));
  float taps = clamp(ceil(longer / shorter - 0.2), 1.0, float(ANISOTROPIC));
  float level = log2(max(longer / taps, shorter));
  vec2 apart = (across_length > down_length ? across : down) / taps;
  vec2 at = uv - apart * (0.5 * (taps - 1.0));
  vec4 sum = vec4(0.0);
  for (float tap = 0.0; tap < taps; tap += 1.0) {
    sum += textureLod(base, at, level);
    at += apart;
  }
  return sum / taps;
}
#else
vec4 Texel() { return texture(base, uv); }
#endif
#ifdef SHADED
layout(binding = 1) uniform sampler2D shade;
in vec2 shade_uv;
#endif
#ifdef FOGGY
layout(location = 5) uniform vec3 fog_color;
layout(location = 6) uniform float fog_density;
layout(location = 7) uniform vec4 fog_ray;
#endif
out vec4 color;
void main() {
  vec4 texel = Texel();
#ifdef ALPHA_TESTED
  if (texel.a < 0.5) discard;
#endif
  float cosine = max(gl_FrontFacing ? sun : -sun, 0.0);
  vec3 seen = texel.rgb * min(constant_light + sun_light * cosine, vec3(1.0));
#ifdef SHADED
  seen *= texture(shade, shade_uv).rgb;
#endif
#ifdef FOGGY
  vec2 ray = fog_ray.zw + fog_ray.xy * gl_FragCoord.xy;
  float distance_m = sqrt(1.0 + dot(ray, ray)) / gl_FragCoord.w;
  seen = mix(fog_color, seen, exp(-fog_density * distance_m));
#endif
  color = vec4(seen, 1.0);
}
)";

// One triangle that covers the picture, at infinity (depth 0).
constexpr const char* kSkyVertex = R"(#version 450 core
layout(location = 0) uniform mat3 scene_from_ndc;
out vec3 ray;
void main() {
  vec2 ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(ndc, 0.0, 1.0);
  ray = scene_from_ndc * vec3(ndc, 1.0);
}
)";

// The fog of the sky is a layer 60 m high: thick at the horizon, thin overhead.
constexpr const char* kSkyFragment = R"(
layout(location = 1) uniform vec3 sky_color;
layout(location = 2) uniform vec3 tint;
layout(location = 3) uniform vec3 band;
layout(location = 4) uniform float level;
layout(location = 8) uniform vec3 color_below;
layout(binding = 0) uniform sampler2D picture;
#ifdef FOGGY
layout(location = 5) uniform vec3 fog_color;
layout(location = 6) uniform float fog_density;
#endif
in vec3 ray;
out vec4 color;
void main() {
  float slope = ray.z / length(ray.xy);
  float height = (slope - band.x) / (band.y - band.x);
  vec3 seen = height < 0.0 ? color_below : sky_color;
  if (level >= 0.0 && height >= 0.0 && height <= 1.0) {
    float u = -atan(ray.y, ray.x) * band.z * 0.15915494;
    seen = textureLod(picture, vec2(u, 1.0 - height), level).rgb;
  }
  seen *= tint;
#ifdef FOGGY
  float sine = max(ray.z / length(ray), 1e-4);
  seen = mix(fog_color, seen, exp(-fog_density * 60.0 / sine));
#endif
  color = vec4(seen, 1.0);
}
)";

}  // namespace

std::string SurfaceVertexShader(const SurfaceShaderKind& kind) {
  return Header(kind) + kSurfaceVertex;
}

std::string SurfaceFragmentShader(const SurfaceShaderKind& kind) {
  return Header(kind) + kSurfaceFragment;
}

std::string SkyVertexShader() { return kSkyVertex; }

std::string SkyFragmentShader(bool has_fog) { return Header({.has_fog = has_fog}) + kSkyFragment; }

}  // namespace lift_slam
