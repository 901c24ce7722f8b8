#include "lift_slam/simulation/light_image.h"

#include <array>
#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {

ByteImage ToBytes(const RenderedView& view, ImageColor color) {
  ByteImage image{view.width, view.height, 3, {}};
  if (color == ImageColor::kRgb) {
    image.values = view.rgb;
    return image;
  }
  image.channels = 1;
  image.values.resize(view.rgb.size() / 3);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const std::uint8_t* rgb = &view.rgb[3 * i];
    // Shares of 2^15, of sum 2^15.
    const int weighted = 9798 * rgb[0] + 19235 * rgb[1] + 3735 * rgb[2];
    image.values[i] = static_cast<std::uint8_t>((weighted + (1 << 14)) >> 15);
  }
  return image;
}

LightImage ToLight(const ByteImage& image) {
  std::array<float, 256> light{};
  for (std::size_t i = 0; i < light.size(); ++i) {
    light[i] = static_cast<float>(std::pow(static_cast<double>(i) / 255.0, kSceneGamma));
  }
  LightImage result{image.width, image.height, image.channels, {}};
  result.values.reserve(image.values.size());
  for (const std::uint8_t value : image.values) result.values.push_back(light[value]);
  return result;
}

void AddLight(const LightImage& image, float weight, int first_row, int end_row, LightImage& sum) {
  if (sum.values.empty()) {
    sum = {image.width, image.height, image.channels, {}};
    sum.values.assign(image.values.size(), 0.0F);
  }
  LIFT_SLAM_CHECK(sum.values.size() == image.values.size(), "sizes {} and {}", sum.values.size(),
                  image.values.size());
  const auto row_size = static_cast<std::size_t>(image.width * image.channels);
  const std::size_t end = row_size * static_cast<std::size_t>(end_row);
  for (std::size_t i = row_size * static_cast<std::size_t>(first_row); i < end; ++i) {
    sum.values[i] += weight * image.values[i];
  }
}

ByteImage Develop(const LightImage& image, double gamma) {
  ByteImage result{image.width, image.height, image.channels, {}};
  result.values.reserve(image.values.size());
  const auto exponent = static_cast<float>(1.0 / gamma);
  for (const float light : image.values) {
    const float value = 255.0F * std::pow(std::clamp(light, 0.0F, 1.0F), exponent);
    result.values.push_back(static_cast<std::uint8_t>(value + 0.5F));
  }
  return result;
}

}  // namespace lift_slam
