#include "lift_slam/image/self_similarity.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lift_slam {
namespace {

constexpr int kHalf = 5;  // the patch has 11 x 11 pixels
constexpr int kSide = 2 * kHalf + 1;
constexpr int kArea = kSide * kSide;
constexpr double kMinContrast = 1.0;  // RMS, grey levels

// A strip of the image along a line, column by column; the patch is in its middle.
struct Strip {
  int reach = 0;             // columns beyond the patch on each side, at most
  int first = 0, last = -1;  // offsets of columns that lie in the image, of -reach-kHalf ...
  std::vector<float> gray;   // kSide a column

  const float* Column(int offset) const {
    return gray.data() + static_cast<std::size_t>((offset + reach + kHalf) * kSide);
  }
};

const PyramidLevel& NearestLevel(const ImagePyramid& image, double scale) {
  return *std::ranges::min_element(image, {}, [&](const PyramidLevel& level) {
    return std::abs(std::log(level.scale_x / scale));
  });
}

bool Sample(const GrayImage& image, double x, double y, float* value) {
  const double floor_x = std::floor(x), floor_y = std::floor(y);
  if (!(floor_x >= 0.0 && floor_y >= 0.0 && floor_x < image.width() - 1 &&
        floor_y < image.height() - 1)) {
    return false;
  }
  const auto column = static_cast<int>(floor_x), row = static_cast<int>(floor_y);
  const auto u = static_cast<float>(x - floor_x), v = static_cast<float>(y - floor_y);
  const auto at = [](const std::uint8_t* p, float w) {
    return static_cast<float>(p[0]) * (1.0F - w) + static_cast<float>(p[1]) * w;
  };
  *value = at(image.row(row) + column, u) * (1.0F - v) + at(image.row(row + 1) + column, u) * v;
  return true;
}

// Columns from the middle outwards until one leaves the image.
Strip CutStrip(const PyramidLevel& level, const Eigen::Vector2d& center,
               const Eigen::Vector2d& direction, double step, int reach) {
  Strip strip;
  strip.reach = reach;
  strip.gray.resize(static_cast<std::size_t>((2 * (reach + kHalf) + 1) * kSide));
  const Eigen::Vector2d across(-direction.y(), direction.x());
  const auto cut = [&](int offset) {
    float* column = strip.gray.data() + (offset + reach + kHalf) * kSide;
    for (int k = -kHalf; k <= kHalf; ++k) {
      const Eigen::Vector2d p = center + step * (offset * direction + k * across);
      if (!Sample(level.image, p.x(), p.y(), column + k + kHalf)) return false;
    }
    return true;
  };
  int end = 0;
  while (end <= reach + kHalf && cut(end)) ++end;
  int begin = end > 0 ? -1 : 0;
  while (begin >= -reach - kHalf && cut(begin)) --begin;
  strip.first = begin + 1;
  strip.last = end - 1;
  return strip;
}

struct Moments {
  float mean = 0.0F, deviation = 0.0F;  // deviation times sqrt(kArea)
};

using Patch = Eigen::Map<const Eigen::Vector<float, kArea>>;

Patch PatchAt(const Strip& strip, int offset) { return Patch(strip.Column(offset - kHalf)); }

Moments MomentsOf(const Patch& patch) {
  const float sum = patch.sum(), mean = sum / kArea;
  return {mean, std::sqrt(std::max(0.0F, patch.squaredNorm() - sum * mean))};
}

double Correlation(const Strip& strip, const Moments& middle, int offset) {
  const Patch patch = PatchAt(strip, offset);
  const Moments moments = MomentsOf(patch);
  if (!(moments.deviation > kMinContrast * kSide)) return -1.0;
  const float product = PatchAt(strip, 0).dot(patch);
  return (product - kArea * middle.mean * moments.mean) / (middle.deviation * moments.deviation);
}

}  // namespace

double SelfSimilarityAlong(const ImagePyramid& image, const Eigen::Vector2d& center,
                           const Eigen::Vector2d& direction, double scale,
                           const SelfSimilarityOptions& options) {
  if (image.empty() || !(direction.norm() > 0.0)) return -1.0;
  const PyramidLevel& level = NearestLevel(image, scale);
  const Eigen::Vector2d at_level((center.x() + 0.5) / level.scale_x - 0.5,
                                 (center.y() + 0.5) / level.scale_y - 0.5);
  const Strip strip = CutStrip(level, at_level, direction.normalized(), scale / level.scale_x,
                               static_cast<int>(options.reach_px));
  if (strip.first > -kHalf || strip.last < kHalf) return -1.0;
  const Moments middle = MomentsOf(PatchAt(strip, 0));
  if (!(middle.deviation > kMinContrast * kSide)) return 1.0;
  const int nearest = static_cast<int>(std::ceil(options.min_offset_px));
  double largest = -1.0;
  for (int offset = strip.first + kHalf; offset <= strip.last - kHalf; ++offset) {
    if (std::abs(offset) < nearest) continue;
    largest = std::max(largest, Correlation(strip, middle, offset));
  }
  return largest;
}

}  // namespace lift_slam
