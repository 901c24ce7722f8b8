#include "lift_slam/features/orb/corner_orientation.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace lift_slam {
namespace {

constexpr int kRadius = kOrientationRadius;
constexpr int kColumns = 32;  // 31, and one of weight 0 to fill the vector registers

using Columns = std::array<std::int16_t, kColumns>;

// inside[v][u + kRadius]: 1 where (u, v) lies in the disc, v >= 0.
constexpr auto MakeDisc() {
  std::array<std::array<std::uint8_t, kColumns>, kRadius + 1> inside{};
  for (int v = 0; v <= kRadius; ++v) {
    for (int u = -kRadius; u <= kRadius; ++u) {
      // (r + 1/2)^2 without the quarter
      const bool is_inside = u * u + v * v <= kRadius * kRadius + kRadius;
      inside[static_cast<std::size_t>(v)][static_cast<std::size_t>(u + kRadius)] = is_inside;
    }
  }
  return inside;
}
constexpr auto kInside = MakeDisc();

}  // namespace

float IntensityCentroidAngle(const GrayImage& image, int x, int y) {
  // Per column u: sum of grey values, and sum of v times grey value. Both fit 16 bits:
  // 31 * 255 = 7905 and (1 + ... + 15) * 255 = 30600.
  Columns sum, sum_v{};
  const std::uint8_t* middle = image.row(y) + x - kRadius;
  for (std::size_t i = 0; i < kColumns; ++i) {
    sum[i] = static_cast<std::int16_t>(middle[i] * kInside[0][i]);
  }
  for (int v = 1; v <= kRadius; ++v) {
    const std::uint8_t* above = image.row(y - v) + x - kRadius;
    const std::uint8_t* below = image.row(y + v) + x - kRadius;
    const auto& inside = kInside[static_cast<std::size_t>(v)];
    for (std::size_t i = 0; i < kColumns; ++i) {
      const auto high = static_cast<std::int16_t>(above[i] * inside[i]);
      const auto low = static_cast<std::int16_t>(below[i] * inside[i]);
      sum[i] = static_cast<std::int16_t>(sum[i] + high + low);
      sum_v[i] = static_cast<std::int16_t>(sum_v[i] + v * (low - high));
    }
  }
  int moment_x = 0, moment_y = 0;
  for (int i = 0; i < kColumns; ++i) {
    moment_x += (i - kRadius) * sum[static_cast<std::size_t>(i)];
    moment_y += sum_v[static_cast<std::size_t>(i)];
  }
  return std::atan2(static_cast<float>(moment_y), static_cast<float>(moment_x));
}

}  // namespace lift_slam
