#include "lift_slam/features/orb/corner_refinement.h"

#include <algorithm>

namespace lift_slam {

// Least squares of z(u, v) = a + b u + c v + d u^2 + e v^2 + f u v over u, v in {-1, 0, 1}.
RefinedPosition RefineCorner(const FastScoreMap& scores, const Corner& corner) {
  int sum_u = 0, sum_v = 0, sum_uv = 0;  // of u z, v z, u v z
  int curvature_u = 0, curvature_v = 0;  // of (3 u^2 - 2) z, (3 v^2 - 2) z
  for (int v = -1; v <= 1; ++v) {
    for (int u = -1; u <= 1; ++u) {
      const int z = scores.Score(corner.x + u, corner.y + v);
      sum_u += u * z;
      sum_v += v * z;
      sum_uv += u * v * z;
      curvature_u += (3 * u * u - 2) * z;
      curvature_v += (3 * v * v - 2) * z;
    }
  }
  const auto x = static_cast<float>(corner.x), y = static_cast<float>(corner.y);
  const float b = static_cast<float>(sum_u) / 6.0F, c = static_cast<float>(sum_v) / 6.0F;
  const float d = static_cast<float>(curvature_u) / 6.0F;
  const float e = static_cast<float>(curvature_v) / 6.0F;
  const float f = static_cast<float>(sum_uv) / 4.0F;
  const float determinant = 4.0F * d * e - f * f;
  if (d >= 0.0F || determinant <= 0.0F) return {x, y};
  return {x + std::clamp((f * c - 2.0F * e * b) / determinant, -0.5F, 0.5F),
          y + std::clamp((f * b - 2.0F * d * c) / determinant, -0.5F, 0.5F)};
}

}  // namespace lift_slam
