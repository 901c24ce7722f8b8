#include "lift_slam/simulation/scene/torcs_sky.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>

#include "lift_slam/simulation/scene/texture_file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr double kFadeShare = 0.125;         // of the picture's height, at each rim
constexpr float kOpenGlSceneAmbient = 0.2F;  // OpenGL's own ambient light, which TORCS leaves on

std::uint8_t* Row(SceneTexture& texture, int y) {
  return texture.rgba.data() +
         static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) * 4;
}

std::uint8_t ToByte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

// Puts the pixels of row y towards a colour: weight 0 leaves them, 1 replaces them.
void MixRow(SceneTexture& texture, int y, const Eigen::Vector3f& color, float weight) {
  std::uint8_t* row = Row(texture, y);
  for (int i = 0; i < 4 * texture.width; ++i) {
    if (i % 4 == 3) continue;
    row[i] = ToByte(static_cast<float>(row[i]) / 255.0F * (1.0F - weight) + color[i % 4] * weight);
  }
}

void BlendOver(SceneTexture& texture, const Eigen::Vector3f& color) {
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    const float alpha = static_cast<float>(texture.rgba[i + 3]) / 255.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const float own = static_cast<float>(texture.rgba[i + k]) / 255.0F;
      texture.rgba[i + k] =
          ToByte(own * alpha + color[static_cast<Eigen::Index>(k)] * (1.0F - alpha));
    }
    texture.rgba[i + 3] = 255;
  }
  texture.has_alpha = false;
}

Eigen::Vector3f MeanOfRow(SceneTexture& texture, int y) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  const std::uint8_t* row = Row(texture, y);
  for (int x = 0; x < texture.width; ++x) {
    sum += Eigen::Vector3f(row[4 * x], row[4 * x + 1], row[4 * x + 2]);
  }
  return sum / (255.0F * static_cast<float>(texture.width));
}

// The lower half, and the upper half to its right.
SceneTexture HalvesSideBySide(SceneTexture& picture) {
  SceneTexture strip;
  strip.name = picture.name;
  strip.width = 2 * picture.width;
  strip.height = picture.height / 2;
  const std::size_t row_bytes = static_cast<std::size_t>(picture.width) * 4;
  strip.rgba.resize(2 * row_bytes * static_cast<std::size_t>(strip.height));
  for (int y = 0; y < strip.height; ++y) {
    std::memcpy(Row(strip, y), Row(picture, y + picture.height - strip.height), row_bytes);
    std::memcpy(Row(strip, y) + row_bytes, Row(picture, y), row_bytes);
  }
  return strip;
}

bool IsBlack(SceneTexture& strip, int y) { return MeanOfRow(strip, y).maxCoeff() < 0.01F; }

// A picture may be left black below its landscape (e-track-6): the landscape's lowest colour there.
void FillBlackBottom(SceneTexture& strip) {
  int lowest = strip.height - 1;
  while (lowest > 0 && IsBlack(strip, lowest)) --lowest;
  if (lowest == strip.height - 1) return;
  const int kept = std::max(lowest - 2, 0);  // the rows at the border are darkened by it
  const Eigen::Vector3f color = MeanOfRow(strip, kept);
  for (int y = kept + 1; y < strip.height; ++y) MixRow(strip, y, color, 1.0F);
}

void FadeRims(SceneTexture& strip, const SceneSky& sky) {
  const int rows = static_cast<int>(kFadeShare * strip.height);
  for (int y = 0; y < rows; ++y) {
    const float weight = 1.0F - static_cast<float>(y) / static_cast<float>(rows);
    MixRow(strip, y, sky.color, weight);
    MixRow(strip, strip.height - 1 - y, sky.color_below, weight);
  }
}

SceneTexture ReadPicture(const TorcsTrack& track) {
  SceneTexture picture = ReadTextureFile(track.folder / track.background_picture);
  BlendOver(picture, track.background_color);
  if (track.background_type != 2) return picture;
  if (picture.height < 2) {
    throw InputError(fmt::format("{}: expected a picture of two halves",
                                 (track.folder / track.background_picture).string()));
  }
  return HalvesSideBySide(picture);
}

void AddLight(const TorcsTrack& track, SceneLight& light) {
  light.ambient = track.ambient + Eigen::Vector3f::Constant(kOpenGlSceneAmbient);
  light.diffuse = track.diffuse;
  if (track.light_position.squaredNorm() > 0.0F) {
    light.to_sun = track.light_position.stableNormalized();
  }
}

}  // namespace

void AddTorcsSky(const TorcsTrack& track, Scene& scene) {
  AddLight(track, scene.light);
  SceneSky& sky = scene.sky;
  sky.color = sky.color_below = track.background_color;
  const int type = track.background_type;
  if (type != 0 && type != 2 && type != 4) {
    throw InputError(fmt::format("{}: Graphic/background type: expected 0, 2 or 4, found {}",
                                 (track.folder / (track.name + ".xml")).string(), type));
  }
  if (track.background_picture.empty()) return;
  SceneTexture strip = ReadPicture(track);
  FillBlackBottom(strip);
  sky.bottom_elevation_rad = std::atan(type == 4 ? -1.0 : -0.5);
  sky.top_elevation_rad = std::atan(1.0);
  sky.repeats = type == 4 ? 1.0 : type == 2 ? 2.0 : 4.0;
  sky.color = MeanOfRow(strip, 0);
  sky.color_below = MeanOfRow(strip, strip.height - 1);
  FadeRims(strip, sky);
  scene.textures.push_back(std::move(strip));
  sky.texture = static_cast<int>(scene.textures.size()) - 1;
}

}  // namespace lift_slam
