#include "lift_slam/features/lift/patch_sampling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// The samples of one row of a patch: the first of the four pixels around each, and where between
// them it lies. Computed for a whole row before any pixel is read, since the compiler then does
// several at once.
struct SampleRow {
  explicit SampleRow(int size)
      : column(static_cast<std::size_t>(size)),
        row(column.size()),
        fx(column.size()),
        fy(column.size()) {}

  // Coordinates beyond the image are moved to its border. On the last column (or row) the sample
  // belongs to the pair before, at its far end.
  void Place(const GrayImage& image, const PatchFrame& frame, double step, double v) {
    const double cosine = std::cos(frame.angle_rad), sine = std::sin(frame.angle_rad);
    const double first_x = frame.x - frame.half_width_px * cosine - v * sine;
    const double first_y = frame.y - frame.half_width_px * sine + v * cosine;
    const double step_x = step * cosine, step_y = step * sine;
    const int last_column = image.width() - 2, last_row = image.height() - 2;
    const auto size = static_cast<int>(column.size());
    for (int j = 0; j < size; ++j) {
      const double x = std::clamp(first_x + j * step_x, 0.0, last_column + 1.0);
      const double y = std::clamp(first_y + j * step_y, 0.0, last_row + 1.0);
      const auto i = static_cast<std::size_t>(j);
      column[i] = std::min(static_cast<int>(x), last_column);
      row[i] = std::min(static_cast<int>(y), last_row);
      fx[i] = static_cast<float>(x - column[i]);
      fy[i] = static_cast<float>(y - row[i]);
    }
  }

  std::vector<int> column, row;
  std::vector<float> fx, fy;
};

void Put(float value, float& target) { target = value; }
void Put(float value, std::uint8_t& target) {
  target = static_cast<std::uint8_t>(static_cast<int>(value + 0.5F));
}

template <class Value>
void Sample(const GrayImage& image, const PatchFrame& frame, int size, std::span<Value> patch) {
  LIFT_SLAM_CHECK(size >= 2 && patch.size() == static_cast<std::size_t>(size) * size,
                  "{} values for a patch of size {}", patch.size(), size);
  LIFT_SLAM_CHECK(image.width() >= 2 && image.height() >= 2, "a patch from an image of {} x {}",
                  image.width(), image.height());
  const double step = 2.0 * frame.half_width_px / (size - 1);
  const std::uint8_t* pixels = image.row(0);
  const std::ptrdiff_t stride = image.row(1) - pixels;
  SampleRow samples(size);
  Value* target = patch.data();
  for (int i = 0; i < size; ++i) {
    samples.Place(image, frame, step, i * step - frame.half_width_px);
    for (std::size_t j = 0; j < samples.column.size(); ++j, ++target) {
      const std::uint8_t* top = pixels + samples.row[j] * stride + samples.column[j];
      const auto between = [&](const std::uint8_t* pair) {
        return static_cast<float>(pair[0]) + samples.fx[j] * static_cast<float>(pair[1] - pair[0]);
      };
      const float upper = between(top), lower = between(top + stride);
      Put(upper + samples.fy[j] * (lower - upper), *target);
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
