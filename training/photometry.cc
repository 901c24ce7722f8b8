#include "training/photometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lift_slam/util/check.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam::training {
namespace {

constexpr std::size_t kNormals = 1 << 16;

// Normal numbers to take a run of, from a random place: one per pixel would cost more than the
// patch itself.
const std::vector<float>& Normals() {
  static const std::vector<float> normals = [] {
    Random random(20231);
    std::vector<float> values(kNormals);
    for (float& value : values) value = static_cast<float>(random.Normal());
    return values;
  }();
  return normals;
}

double LogUniform(double largest, Random& random) {
  return std::pow(largest, random.Uniform(-1.0, 1.0));
}

// (1, 2, 1) / 4 along rows and then columns, in place; the border keeps its outermost pixels.
void Smooth(std::span<std::uint8_t> patch, int size) {
  const auto n = static_cast<std::size_t>(size);
  const auto smooth_line = [&](std::size_t first, std::size_t stride) {
    int before = patch[first];
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = first + i * stride;
      const int here = patch[at], after = i + 1 < n ? patch[at + stride] : here;
      patch[at] = static_cast<std::uint8_t>((before + 2 * here + after + 2) / 4);
      before = here;
    }
  };
  for (std::size_t i = 0; i < n; ++i) smooth_line(i * n, 1);
  for (std::size_t i = 0; i < n; ++i) smooth_line(i, n);
}

std::array<float, 256> ToneCurve(const PhotometryOptions& options, Random& random) {
  const bool strong = random.Uniform() < options.gamma_share;
  const double gamma =
      LogUniform(strong ? options.max_gamma : std::min(1.4, options.max_gamma), random);
  const double gain = LogUniform(options.max_gain, random);
  const double offset = random.Uniform(-options.max_offset, options.max_offset);
  std::array<float, 256> curve{};
  for (std::size_t i = 0; i < curve.size(); ++i) {
    curve[i] =
        static_cast<float>(offset + 255.0 * gain * std::pow(static_cast<double>(i) / 255.0, gamma));
  }
  return curve;
}

}  // namespace

void PhotometryOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("max_gamma", max_gamma, "grey^gamma, between its inverse and this");
  visitor.Field("gamma_share", gamma_share, "share of patches with so strong a gamma");
  visitor.Field("max_gain", max_gain, "between its inverse and this");
  visitor.Field("max_offset", max_offset, "grey values");
  visitor.Field("max_noise", max_noise, "standard deviation, grey values");
  visitor.Field("blurred_share", blurred_share, "share of patches that are smoothed");
}

void PhotometryOptions::Check() const {
  CheckOptionRange("photometry.max_gamma", max_gamma, 1.0, 10.0);
  CheckOptionRange("photometry.gamma_share", gamma_share, 0.0, 1.0);
  CheckOptionRange("photometry.max_gain", max_gain, 1.0, 10.0);
  CheckOptionRange("photometry.max_offset", max_offset, 0.0, 255.0);
  CheckOptionRange("photometry.max_noise", max_noise, 0.0, 100.0);
  CheckOptionRange("photometry.blurred_share", blurred_share, 0.0, 1.0);
}

void ChangeLight(std::span<std::uint8_t> patch, int size, const PhotometryOptions& options,
                 Random& random) {
  LIFT_SLAM_CHECK(patch.size() == static_cast<std::size_t>(size) * size && patch.size() < kNormals,
                  "{} values for a patch of size {}", patch.size(), size);
  if (random.Uniform() < options.blurred_share) {
    Smooth(patch, size);
    if (random.Uniform() < 0.5) Smooth(patch, size);
  }
  const std::array<float, 256> curve = ToneCurve(options, random);
  const auto noise = static_cast<float>(random.Uniform(0.0, options.max_noise));
  const auto first =
      static_cast<std::size_t>(random.UniformInt(0, static_cast<int>(kNormals - patch.size()) - 1));
  const float* normals = &Normals()[first];
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const float value = curve[patch[i]] + noise * normals[i];
    patch[i] = static_cast<std::uint8_t>(static_cast<int>(std::clamp(value, 0.0F, 255.0F) + 0.5F));
  }
}

}  // namespace lift_slam::training
