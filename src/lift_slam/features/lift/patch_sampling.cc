#include "lift_slam/features/lift/patch_sampling.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

float Interpolate(float top_left, float top_right, float bottom_left, float bottom_right, float fx,
                  float fy) {
  const float top = top_left + fx * (top_right - top_left);
  const float bottom = bottom_left + fx * (bottom_right - bottom_left);
  return top + fy * (bottom - top);
}

// X and Y lie in the image.
float SampleInside(const GrayImage& image, double x, double y) {
  const int column = std::min(static_cast<int>(x), image.width() - 1);
  const int row = std::min(static_cast<int>(y), image.height() - 1);
  const int right = std::min(column + 1, image.width() - 1);
  const std::uint8_t* top = image.row(row);
  const std::uint8_t* bottom = image.row(std::min(row + 1, image.height() - 1));
  return Interpolate(top[column], top[right], bottom[column], bottom[right],
                     static_cast<float>(x - column), static_cast<float>(y - row));
}

void Put(float value, float& target) { target = value; }
void Put(float value, std::uint8_t& target) { target = static_cast<std::uint8_t>(value + 0.5F); }

template <class Value>
void Sample(const GrayImage& image, const PatchFrame& frame, int size, std::span<Value> patch) {
  LIFT_SLAM_CHECK(size >= 2 && patch.size() == static_cast<std::size_t>(size) * size,
                  "{} values for a patch of size {}", patch.size(), size);
  LIFT_SLAM_CHECK(!image.empty(), "a patch from an empty image");
  const double step = 2.0 * frame.half_width_px / (size - 1);
  const double cosine = std::cos(frame.angle_rad), sine = std::sin(frame.angle_rad);
  const double last_x = image.width() - 1, last_y = image.height() - 1;
  Value* target = patch.data();
  for (int i = 0; i < size; ++i) {
    const double v = i * step - frame.half_width_px;
    for (int j = 0; j < size; ++j, ++target) {
      const double u = j * step - frame.half_width_px;
      const double x = std::clamp(frame.x + u * cosine - v * sine, 0.0, last_x);
      const double y = std::clamp(frame.y + u * sine + v * cosine, 0.0, last_y);
      Put(SampleInside(image, x, y), *target);
    }
  }
}

}  // namespace

void SamplePatch(const GrayImage& image, const PatchFrame& frame, int size,
                 std::span<float> patch) {
  Sample(image, frame, size, patch);
}

void SamplePatch(const GrayImage& image, const PatchFrame& frame, int size,
                 std::span<std::uint8_t> patch) {
  Sample(image, frame, size, patch);
}

bool LiesWithin(const GrayImage& image, double x, double y, double half_width_px) {
  return x - half_width_px >= 0 && y - half_width_px >= 0 &&
         x + half_width_px <= image.width() - 1 && y + half_width_px <= image.height() - 1;
}

}  // namespace lift_slam
