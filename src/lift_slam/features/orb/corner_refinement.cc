#include "lift_slam/features/orb/corner_refinement.h"

#include <algorithm>
#include <cmath>

namespace lift_slam {
namespace {

float ParabolaPeak(float before, float at, float after) {
  const float curvature = before - 2.0F * at + after;
  if (curvature >= 0.0F) return 0.0F;
  return std::clamp(0.5F * (before - after) / curvature, -0.5F, 0.5F);
}

float SmallerEigenvalue(const GrayImage& image, int center_x, int center_y) {
  constexpr int kRadius = 3;
  int xx = 0, xy = 0, yy = 0;
  for (int y = center_y - kRadius; y <= center_y + kRadius; ++y) {
    const std::uint8_t *above = image.row(y - 1), *at = image.row(y), *below = image.row(y + 1);
    for (int x = center_x - kRadius; x <= center_x + kRadius; ++x) {
      const int dx = at[x + 1] - at[x - 1], dy = below[x] - above[x];
      xx += dx * dx;
      xy += dx * dy;
      yy += dy * dy;
    }
  }
  const auto mean = 0.5F * static_cast<float>(xx + yy);
  return mean - std::hypot(0.5F * static_cast<float>(xx - yy), static_cast<float>(xy));
}

}  // namespace

RefinedPosition RefineCorner(const GrayImage& image, const FastScoreMap& scores,
                             const Corner& corner, SubpixelMethod method) {
  const int x = corner.x, y = corner.y;
  const auto refine = [&](auto score) {
    const float at = score(x, y);
    return RefinedPosition{
        static_cast<float>(x) + ParabolaPeak(score(x - 1, y), at, score(x + 1, y)),
        static_cast<float>(y) + ParabolaPeak(score(x, y - 1), at, score(x, y + 1))};
  };
  switch (method) {
    case SubpixelMethod::kFastScore:
      return refine([&](int u, int v) { return static_cast<float>(scores.Score(u, v)); });
    case SubpixelMethod::kCornerness:
      return refine([&](int u, int v) { return SmallerEigenvalue(image, u, v); });
    case SubpixelMethod::kNone:
      break;
  }
  return {static_cast<float>(x), static_cast<float>(y)};
}

}  // namespace lift_slam
