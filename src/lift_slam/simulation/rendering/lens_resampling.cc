#include "lift_slam/simulation/rendering/lens_resampling.h"

#include <array>
#include <cmath>

namespace lift_slam {
namespace {

// Adds the colour at a place, interpolated between four samples.
void AddColor(const Samples& view, const LensSample& at, std::array<float, 3>& sum) {
  const auto left = static_cast<std::size_t>(at.x);
  const auto top = static_cast<std::size_t>(at.y);
  const float u = at.x - static_cast<float>(left);
  const float v = at.y - static_cast<float>(top);
  const std::size_t stride = 4 * static_cast<std::size_t>(view.width);
  const std::uint8_t* upper = view.rgba.data() + top * stride + 4 * left;
  const std::uint8_t* lower = upper + stride;
  for (std::size_t c = 0; c < 3; ++c) {
    const float a = upper[c], b = upper[c + 4], d = lower[c], e = lower[c + 4];
    const float above = a + u * (b - a);
    sum[c] += above + v * (d + u * (e - d) - above);
  }
}

// True when the step from `from` to `to` goes on from, or into, the step beside it: a plane's
// inverse depth is linear, an edge's is not.
bool IsLinear(float before, float from, float to, float after) {
  const float step = to - from;
  const float tolerance = 0.05F * std::abs(step) + 1e-5F * std::abs(from);
  return std::abs(from - before - step) <= tolerance || std::abs(after - to - step) <= tolerance;
}

// The depth buffer's value at a place: interpolated on planes, else the nearest sample's.
float BufferValue(const Samples& view, const LensSample& at) {
  const auto left = static_cast<std::ptrdiff_t>(at.x);
  const auto top = static_cast<std::ptrdiff_t>(at.y);
  const std::ptrdiff_t stride = view.width;
  const float u = at.x - static_cast<float>(left);
  const float v = at.y - static_cast<float>(top);
  const float* a = view.depth.data() + top * stride + left;
  const float* nearest = a + (u < 0.5F ? 0 : 1) + (v < 0.5F ? 0 : stride);
  if (!(a[0] > 0.0F && a[1] > 0.0F && a[stride] > 0.0F && a[stride + 1] > 0.0F)) return *nearest;
  const float* row = v < 0.5F ? a : a + stride;
  const float* column = u < 0.5F ? a : a + 1;
  const float twist = a[0] + a[stride + 1] - a[1] - a[stride];
  const bool is_plane = IsLinear(row[-1], row[0], row[1], row[2]) &&
                        IsLinear(column[-stride], column[0], column[stride], column[2 * stride]) &&
                        std::abs(twist) <= 1e-4F * a[0];
  if (!is_plane) return *nearest;
  return (1.0F - v) * (a[0] + u * (a[1] - a[0])) +
         v * (a[stride] + u * (a[stride + 1] - a[stride]));
}

}  // namespace

std::vector<std::uint8_t> ResampleColor(const LensMap& map, const std::vector<Samples>& views) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * map.centers.size());
  const LensSample* sample = map.samples.data();
  for (std::size_t pixel = 0; pixel < map.centers.size(); ++pixel) {
    std::array<float, 3> sum{};
    int count = 0;
    for (int i = 0; i < map.samples_per_pixel; ++i, ++sample) {
      if (sample->view < 0) continue;
      AddColor(views[static_cast<std::size_t>(sample->view)], *sample, sum);
      ++count;
    }
    const float scale = count == 0 ? 0.0F : 1.0F / static_cast<float>(count);
    for (const float value : sum) rgb.push_back(static_cast<std::uint8_t>(scale * value + 0.5F));
  }
  return rgb;
}

std::vector<float> ResampleDepth(const LensMap& map, const std::vector<Samples>& views,
                                 const DepthRange& range) {
  std::vector<float> depth;
  depth.reserve(map.centers.size());
  for (const LensSample& at : map.centers) {
    const auto view = static_cast<std::size_t>(std::max(at.view, 0));
    const float value = at.view < 0 ? 0.0F : BufferValue(views[view], at);
    if (!(value > 0.0F)) {
      depth.push_back(0.0F);
      continue;
    }
    const PinholeView& pinhole_view = map.views[view];
    const Eigen::Vector3d ray = pinhole_view.pinhole.Unproject({at.x, at.y});
    const double z_per_depth = pinhole_view.view_from_cam.col(2).dot(ray);
    depth.push_back(static_cast<float>(z_per_depth / range.InverseDepth(value)));
  }
  return depth;
}

}  // namespace lift_slam
