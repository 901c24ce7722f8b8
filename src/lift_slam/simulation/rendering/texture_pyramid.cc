#include "lift_slam/simulation/rendering/texture_pyramid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr int kOpaque = 128;  // alpha >= 0.5 of 255

void Check(const SceneTexture& texture) {
  const auto width = static_cast<std::size_t>(std::max(texture.width, 0));
  const auto height = static_cast<std::size_t>(std::max(texture.height, 0));
  if (width > 0 && height > 0 && texture.rgba.size() == 4 * width * height) return;
  throw InputError(fmt::format(
      "texture '{}' of {} x {} pixels has {} bytes, expected a positive size and 4 bytes "
      "a pixel",
      texture.name, texture.width, texture.height, texture.rgba.size()));
}

// The source texels that one target texel covers: [first, end).
struct Span {
  int first, end;
};
Span Covered(int target, int target_size, int source_size) {
  const int first = target * source_size / target_size;
  return {first, std::max(first + 1, (target + 1) * source_size / target_size)};
}

// Mean of a block of texels; colours weighted by alpha when `by_alpha`.
void AverageBlock(const TextureLevel& source, Span x, Span y, bool by_alpha, std::uint8_t* target) {
  std::array<unsigned int, 4> sum{};
  unsigned int weights = 0;
  unsigned int count = 0;
  for (int row = y.first; row < y.end; ++row) {
    const std::uint8_t* texel =
        source.rgba.data() +
        4 * (std::size_t(row) * std::size_t(source.width) + std::size_t(x.first));
    for (int column = x.first; column < x.end; ++column, texel += 4) {
      const unsigned int weight = by_alpha ? texel[3] : 1U;
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * texel[c];
      sum[3] += texel[3];
      weights += weight;
      ++count;
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    target[c] = weights == 0 ? std::uint8_t{0}
                             : static_cast<std::uint8_t>((sum[c] + weights / 2) / weights);
  }
  target[3] = static_cast<std::uint8_t>((sum[3] + count / 2) / count);
}

TextureLevel Halve(const TextureLevel& source, bool by_alpha) {
  TextureLevel target{std::max(source.width / 2, 1), std::max(source.height / 2, 1), {}};
  target.rgba.resize(4 * std::size_t(target.width) * std::size_t(target.height));
  std::uint8_t* texel = target.rgba.data();
  for (int y = 0; y < target.height; ++y) {
    const Span rows = Covered(y, target.height, source.height);
    for (int x = 0; x < target.width; ++x, texel += 4) {
      AverageBlock(source, Covered(x, target.width, source.width), rows, by_alpha, texel);
    }
  }
  return target;
}

// Gives the texels without any alpha the colour of the coarser level.
void FillTransparent(const TextureLevel& coarse, TextureLevel& fine) {
  std::uint8_t* texel = fine.rgba.data();
  for (int y = 0; y < fine.height; ++y) {
    const int row = std::min(y / 2, coarse.height - 1);
    for (int x = 0; x < fine.width; ++x, texel += 4) {
      if (texel[3] != 0) continue;
      const int column = std::min(x / 2, coarse.width - 1);
      const auto at = 4 * (std::size_t(row) * std::size_t(coarse.width) + std::size_t(column));
      std::copy_n(coarse.rgba.data() + at, 3, texel);
    }
  }
}

// The alpha value that the share `coverage` of the texels reaches.
int AlphaAtCoverage(const TextureLevel& level, double coverage) {
  std::array<std::size_t, 256> histogram{};
  for (std::size_t i = 3; i < level.rgba.size(); i += 4) ++histogram[level.rgba[i]];
  const double wanted = coverage * static_cast<double>(level.rgba.size() / 4);
  std::size_t reached = 0;
  for (int alpha = 255; alpha > 1; --alpha) {
    reached += histogram[std::size_t(alpha)];
    if (static_cast<double>(reached) >= wanted - 0.5) return alpha;
  }
  return 1;
}

void KeepCoverage(double coverage, TextureLevel& level) {
  if (coverage <= 0.0 || coverage >= 1.0) return;
  const double scale = kOpaque / static_cast<double>(AlphaAtCoverage(level, coverage));
  for (std::size_t i = 3; i < level.rgba.size(); i += 4) {
    level.rgba[i] = static_cast<std::uint8_t>(std::min(255.0, std::round(scale * level.rgba[i])));
  }
}

}  // namespace

double AlphaCoverage(const TextureLevel& level) {
  std::size_t opaque = 0;
  for (std::size_t i = 3; i < level.rgba.size(); i += 4)
    opaque += level.rgba[i] >= kOpaque ? 1U : 0U;
  return static_cast<double>(opaque) / static_cast<double>(level.rgba.size() / 4);
}

std::vector<TextureLevel> MakeTexturePyramid(const SceneTexture& texture) {
  Check(texture);
  std::vector<TextureLevel> levels = {{texture.width, texture.height, texture.rgba}};
  while (levels.back().width > 1 || levels.back().height > 1) {
    levels.push_back(Halve(levels.back(), texture.has_alpha));
  }
  if (!texture.has_alpha) return levels;
  for (std::size_t i = levels.size() - 1; i > 0; --i) FillTransparent(levels[i], levels[i - 1]);
  const double coverage = AlphaCoverage(levels.front());
  for (std::size_t i = 1; i < levels.size(); ++i) KeepCoverage(coverage, levels[i]);
  return levels;
}

}  // namespace lift_slam
