#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lift_slam {

// A grey square texture that repeats in both directions, with its mip levels.
class Texture {
 public:
  // `size` a power of two; `gray` row by row, size * size values in [0, 255].
  Texture(int size, const std::vector<float>& gray);

  int size() const { return size_; }
  // Grey value at a place in texels of the full size, averaged over about 2^level texels
  // (level >= 0): bilinear in two neighbouring mip levels.
  float Sample(float u, float v, float level) const;

 private:
  struct Level {
    int mask = 0;   // size - 1
    int shift = 0;  // log2(size)
    std::vector<std::uint8_t> gray;
  };
  static float SampleLevel(const Level& level, float u, float v);

  int size_ = 0;
  std::vector<Level> levels_;
};

enum class TextureKind {
  kClutter,  // noise, rotated rectangles, discs and checks: strong corners everywhere
  kFacade,   // plaster with rows of differing windows
  kGround,   // fine noise, specks and cracks
};

// Procedural and deterministic: multi-octave value noise with drawn shapes, 1024 x 1024.
Texture MakeTexture(TextureKind kind, std::uint64_t seed);

}  // namespace lift_slam
