#pragma once

#include <string>

namespace lift_slam {

// GLSL 4.50 sources. Uniforms and inputs have fixed locations, named here for the calls.

// What a surface's shader does; each kind is a program of its own so that the others stay small.
struct SurfaceShaderKind {
  bool is_alpha_tested = false;
  bool has_shade = false;
  bool has_fog = false;
  int anisotropy = 1;  // most taps of the texture filter; alpha-tested surfaces mostly stand
                       // upright and have one
};

// Inputs of the vertex shader.
inline constexpr unsigned int kPositionInput = 0;  // vec3, scene frame
inline constexpr unsigned int kTextureInput = 1;   // vec4: base uv, shade uv
inline constexpr unsigned int kSunInput = 2;       // float: cosine between normal and sun

// Uniforms of the surface programs.
inline constexpr int kClipFromEyeUniform = 0;    // mat4: axes of the scene, origin at the camera
inline constexpr int kEyeHighUniform = 1;        // vec3: the camera centre as a sum of two floats,
inline constexpr int kEyeLowUniform = 2;         // vec3: so that far-off scenes lose no digits
inline constexpr int kConstantLightUniform = 3;  // vec3: emission and ambient
inline constexpr int kSunLightUniform = 4;       // vec3: diffuse
// Uniforms of the sky program.
inline constexpr int kSceneFromNdcUniform = 0;   // mat3: viewing ray of (x, y, 1)
inline constexpr int kSkyColorUniform = 1;       // vec3, above the picture
inline constexpr int kSkyTintUniform = 2;        // vec3: brightness of the picture and the colour
inline constexpr int kSkyBandUniform = 3;        // vec3: tan of bottom and top elevation, repeats
inline constexpr int kSkyLevelUniform = 4;       // float: mip-map level; negative: no picture
inline constexpr int kSkyColorBelowUniform = 8;  // vec3
// Uniforms of both with fog.
inline constexpr int kFogColorUniform = 5;    // vec3
inline constexpr int kFogDensityUniform = 6;  // float: 1 / m
inline constexpr int kFogRayUniform = 7;      // vec4: ray (x, y, 1) = zw + xy * gl_FragCoord.xy

std::string SurfaceVertexShader(const SurfaceShaderKind& kind);
std::string SurfaceFragmentShader(const SurfaceShaderKind& kind);
std::string SkyVertexShader();
std::string SkyFragmentShader(bool has_fog);

}  // namespace lift_slam
