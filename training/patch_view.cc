#include "training/patch_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lift_slam/util/check.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam::training {
namespace {

constexpr double kMaxStepPx = 1.5;  // as features/lift/patch_cutter.cc

// Largest distance in the image that one sigma of the patch's plane covers, at the centre.
double LargestScale(const PatchView& view) {
  const double sum = view.xu * view.xu + view.xv * view.xv + view.yu * view.yu + view.yv * view.yv;
  const double determinant = view.xu * view.yv - view.xv * view.yu;
  const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * determinant * determinant));
  return std::sqrt(0.5 * (sum + root));
}

float Bilinear(const std::uint8_t* pixels, std::ptrdiff_t stride, double x, double y, int last_x,
               int last_y) {
  const int column = std::min(static_cast<int>(x), last_x - 1);
  const int row = std::min(static_cast<int>(y), last_y - 1);
  const auto fx = static_cast<float>(x - column), fy = static_cast<float>(y - row);
  const std::uint8_t* top = pixels + row * stride + column;
  const auto between = [fx](const std::uint8_t* pair) {
    return static_cast<float>(pair[0]) + fx * static_cast<float>(pair[1] - pair[0]);
  };
  const float upper = between(top), lower = between(top + stride);
  return upper + fy * (lower - upper);
}

}  // namespace

void SamplePatchView(const ImagePyramid& pyramid, const PatchView& view, double half_width,
                     int size, std::span<std::uint8_t> patch) {
  LIFT_SLAM_CHECK(size >= 2 && patch.size() == static_cast<std::size_t>(size) * size,
                  "{} values for a patch of size {}", patch.size(), size);
  const double step = 2.0 * half_width / (size - 1);
  const double step_px = step * LargestScale(view);
  std::size_t i = 0;
  while (i + 1 < pyramid.size() && step_px > kMaxStepPx * pyramid[i].scale_x) ++i;
  const PyramidLevel& level = pyramid[i];
  LIFT_SLAM_CHECK(level.image.width() >= 2 && level.image.height() >= 2, "an image of {} x {}",
                  level.image.width(), level.image.height());
  const int last_x = level.image.width() - 1, last_y = level.image.height() - 1;
  const std::uint8_t* pixels = level.image.row(0);
  const std::ptrdiff_t stride = level.image.row(1) - pixels;
  const double offset_x = (view.x + 0.5) / level.scale_x - 0.5;
  const double offset_y = (view.y + 0.5) / level.scale_y - 0.5;
  std::uint8_t* target = patch.data();
  for (int row = 0; row < size; ++row) {
    const double v = row * step - half_width;
    for (int column = 0; column < size; ++column, ++target) {
      const double u = column * step - half_width;
      const double w = 1.0 / (1.0 + view.wu * u + view.wv * v);
      const double x = offset_x + (view.xu * u + view.xv * v) * w / level.scale_x;
      const double y = offset_y + (view.yu * u + view.yv * v) * w / level.scale_y;
      const float value = Bilinear(pixels, stride, std::clamp(x, 0.0, 1.0 * last_x),
                                   std::clamp(y, 0.0, 1.0 * last_y), last_x, last_y);
      *target = static_cast<std::uint8_t>(static_cast<int>(value + 0.5F));
    }
  }
}

PatchView Shifted(const PatchView& view, double u, double v) {
  // The plane's projective map with its origin moved to (u, v), scaled so that w is 1 there.
  const double w = 1.0 + view.wu * u + view.wv * v;
  const double dx = (view.xu * u + view.xv * v) / w, dy = (view.yu * u + view.yv * v) / w;
  PatchView shifted = view;
  shifted.x += dx;
  shifted.y += dy;
  shifted.wu = view.wu / w;
  shifted.wv = view.wv / w;
  // X(u + s) - X(u) = ((xu - dx wu) s + ...) / (w + wu s + ...)
  shifted.xu = (view.xu - dx * view.wu) / w;
  shifted.xv = (view.xv - dx * view.wv) / w;
  shifted.yu = (view.yu - dy * view.wu) / w;
  shifted.yv = (view.yv - dy * view.wv) / w;
  return shifted;
}

void ViewOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("max_tilt", max_tilt, "slant of a point's surroundings when it has one view");
  visitor.Field("max_perspective", max_perspective, "of the same, per sigma");
  visitor.Field("position_noise_sigmas", position_noise_sigmas, "of a keypoint");
  visitor.Field("scale_noise_octaves", scale_noise_octaves, "of a keypoint's sigma");
  visitor.Field("rotation_noise_deg", rotation_noise_deg, "of one patch against the other");
  visitor.Field("turned_share", turned_share,
                "share of pairs of which both patches are turned by one random angle");
}

void ViewOptions::Check() const {
  CheckOptionRange("views.max_tilt", max_tilt, 1.0, 6.0);
  CheckOptionRange("views.max_perspective", max_perspective, 0.0, 0.04);
  CheckOptionRange("views.position_noise_sigmas", position_noise_sigmas, 0.0, 3.0);
  CheckOptionRange("views.scale_noise_octaves", scale_noise_octaves, 0.0, 1.0);
  CheckOptionRange("views.rotation_noise_deg", rotation_noise_deg, 0.0, 180.0);
  CheckOptionRange("views.turned_share", turned_share, 0.0, 1.0);
}

PatchView RandomPatchView(const View& view, double angle_rad, bool warp, const ViewOptions& options,
                          Random& random) {
  const double noise = options.position_noise_sigmas * view.sigma;
  const double sigma = view.sigma * std::exp2(options.scale_noise_octaves * random.Normal());
  const double angle =
      angle_rad + options.rotation_noise_deg * std::numbers::pi / 180.0 * random.Normal();
  PatchView result;
  result.x = view.x + noise * random.Normal();
  result.y = view.y + noise * random.Normal();
  // Stretched along a random direction, by a symmetric matrix: it turns nothing.
  double xx = 1.0, xy = 0.0, yy = 1.0;
  if (warp) {
    const double tilt = std::sqrt(std::pow(options.max_tilt, random.Uniform()));
    const double direction = std::numbers::pi * random.Uniform();
    const double c = std::cos(direction), s = std::sin(direction);
    xx = tilt * c * c + s * s / tilt;
    yy = tilt * s * s + c * c / tilt;
    xy = (tilt - 1.0 / tilt) * c * s;
    result.wu = random.Uniform(-options.max_perspective, options.max_perspective);
    result.wv = random.Uniform(-options.max_perspective, options.max_perspective);
  }
  const double c = std::cos(angle), s = std::sin(angle);
  result.xu = sigma * (xx * c + xy * s);
  result.yu = sigma * (xy * c + yy * s);
  result.xv = sigma * (-xx * s + xy * c);
  result.yv = sigma * (-xy * s + yy * c);
  return result;
}

}  // namespace lift_slam::training
