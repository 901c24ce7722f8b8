#include "lift_slam/features/orb/fast_corners.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// 32 neighbouring pixels at once (vector extension of GCC and Clang).
constexpr int kLanes = 32;
using Pixels = std::uint8_t __attribute__((vector_size(kLanes)));
using RingOffsets = std::array<std::ptrdiff_t, 16>;

RingOffsets MakeRingOffsets(std::ptrdiff_t stride) {
  constexpr std::array<int, 16> dx = {0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3, -3, -3, -2, -1};
  constexpr std::array<int, 16> dy = {-3, -3, -2, -1, 0, 1, 2, 3, 3, 3, 2, 1, 0, -1, -2, -3};
  RingOffsets offsets;
  for (std::size_t k = 0; k < 16; ++k) offsets[k] = dy[k] * stride + dx[k];
  return offsets;
}

inline Pixels Load(const std::uint8_t* from) {
  Pixels pixels;
  std::memcpy(&pixels, from, sizeof pixels);
  return pixels;
}
inline Pixels Min(const Pixels& a, const Pixels& b) { return a < b ? a : b; }
inline Pixels Max(const Pixels& a, const Pixels& b) { return a > b ? a : b; }
inline Pixels SubtractToZero(const Pixels& a, const Pixels& b) { return Max(a, b) - b; }

// Over the 16 arcs of 9 contiguous ring pixels: Outer of (Inner within the arc). The arcs that
// start at 2j and 2j + 1 share the 8 pixels from 2j + 1 on, and
// Outer(Inner(shared, a), Inner(shared, b)) = Inner(shared, Outer(a, b)).
template <class Inner, class Outer>
inline Pixels OverArcs(const Pixels (&ring)[16], Inner inner, Outer outer) {
  Pixels two[8], four[8];
  for (int j = 0; j < 8; ++j) two[j] = inner(ring[2 * j + 1], ring[(2 * j + 2) % 16]);
  for (int j = 0; j < 8; ++j) four[j] = inner(two[j], two[(j + 1) % 8]);
  Pixels result;
  for (int j = 0; j < 8; ++j) {
    const Pixels shared = inner(four[j], four[(j + 2) % 8]);
    const Pixels arc = inner(shared, outer(ring[2 * j], ring[(2 * j + 9) % 16]));
    result = j == 0 ? arc : outer(result, arc);
  }
  return result;
}

void ScorePixels(const std::uint8_t* center, const RingOffsets& offsets, std::uint8_t* scores) {
  Pixels ring[16];
  for (std::size_t k = 0; k < 16; ++k) ring[k] = Load(center + offsets[k]);
  const Pixels middle = Load(center);
  const Pixels bright = SubtractToZero(OverArcs(ring, Min, Max), middle);
  const Pixels dark = SubtractToZero(middle, OverArcs(ring, Max, Min));
  const Pixels score = Max(bright, dark);
  std::memcpy(scores, &score, sizeof score);
}

// Bytes of 0xFF where the pixel is a maximum above the threshold.
inline Pixels MaximumMask(const std::uint8_t* above, const std::uint8_t* at,
                          const std::uint8_t* below, const Pixels& threshold) {
  const Pixels before = Max(Max(Load(above - 1), Load(above)), Max(Load(above + 1), Load(at - 1)));
  const Pixels after = Max(Max(Load(below - 1), Load(below)), Max(Load(below + 1), Load(at + 1)));
  const Pixels score = Load(at);
  return static_cast<Pixels>((score > Max(before, threshold)) & (score >= after));
}

}  // namespace

void FastScoreMap::Compute(const GrayImage& image, int border) {
  LIFT_SLAM_CHECK(border >= 16, "border is {}", border);
  width_ = image.width();
  height_ = image.height();
  border_ = border;
  // The last block of a row runs over its end: in the scores into padding, in the image by at
  // most 35 - border pixels into the next row, which exists because of the border.
  stride_ = static_cast<std::size_t>(width_ + 2 * kLanes);
  const std::size_t size = stride_ * static_cast<std::size_t>(height_);
  if (scores_.size() < size) scores_.resize(size);
  if (width_ <= 2 * border || height_ <= 2 * border) return;
  const RingOffsets offsets = MakeRingOffsets(static_cast<std::ptrdiff_t>(image.mat().step));
  for (int y = border - 1; y <= height_ - border; ++y) {
    const std::uint8_t* pixels = image.row(y);
    std::uint8_t* scores = row(y);
    for (int x = border - 1; x <= width_ - border; x += kLanes) {
      ScorePixels(pixels + x, offsets, scores + x);
    }
  }
}

void FastScoreMap::FindCorners(int threshold, std::vector<Corner>& corners) const {
  corners.clear();
  const Pixels limit = Pixels{} + static_cast<std::uint8_t>(std::clamp(threshold, 0, 255));
  for (int y = border_; y < height_ - border_; ++y) {
    for (int x = border_; x < width_ - border_; x += kLanes) {
      const Pixels mask = MaximumMask(row(y - 1) + x, row(y) + x, row(y + 1) + x, limit);
      std::array<std::uint64_t, kLanes / 8> words;
      std::memcpy(words.data(), &mask, sizeof mask);
      for (int w = 0; w < kLanes / 8; ++w) {
        for (std::uint64_t bits = words[static_cast<std::size_t>(w)]; bits != 0;) {
          const int byte = std::countr_zero(bits) / 8;  // little endian: the first pixel is low
          bits &= ~(std::uint64_t{0xFF} << (8 * byte));
          const int corner_x = x + 8 * w + byte;
          if (corner_x >= width_ - border_) break;
          corners.push_back({static_cast<std::int16_t>(corner_x), static_cast<std::int16_t>(y),
                             row(y)[corner_x]});
        }
      }
    }
  }
}

}  // namespace lift_slam
