#include "lift_slam/features/orb/orb_descriptor.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace lift_slam {
namespace {

constexpr std::size_t kPairs = OrbPattern::kBits;

struct Rotation {
  float cosine, sine;
};

// By way of degrees in single precision, as cv::ORB, so that the same pixels are compared.
Rotation MakeRotation(float angle_rad) {
  constexpr float kDegrees = 180.0F / std::numbers::pi_v<float>;
  constexpr auto kRadians = static_cast<float>(std::numbers::pi / 180.0);
  const double angle = static_cast<double>(angle_rad * kDegrees * kRadians);
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

// To the nearest integer, halves to even, for |value| < 2^22: the sum's last bit is worth 1. A
// form that compilers vectorise.
inline std::int32_t Round(float value) {
  constexpr float kOneAndAHalfTimesTwoTo23 = 12582912.0F;
  return std::bit_cast<std::int32_t>(value + kOneAndAHalfTimesTwoTo23) -
         std::bit_cast<std::int32_t>(kOneAndAHalfTimesTwoTo23);
}

// The grey value at each pattern point, turned. Needs -ffp-contract=off to round like cv::ORB.
void Sample(const std::uint8_t* center, std::int32_t stride, const Rotation& rotation,
            const std::array<float, kPairs>& x, const std::array<float, kPairs>& y,
            std::array<std::uint8_t, kPairs>& values) {
  std::array<std::int32_t, kPairs> offsets;
  for (std::size_t i = 0; i < kPairs; ++i) {
    const std::int32_t u = Round(x[i] * rotation.cosine - y[i] * rotation.sine);
    const std::int32_t v = Round(x[i] * rotation.sine + y[i] * rotation.cosine);
    offsets[i] = v * stride + u;
  }
  for (std::size_t i = 0; i < kPairs; ++i) values[i] = center[offsets[i]];
}

// Bit i % 8 of byte i / 8 is first[i] < second[i].
void Compare(const std::array<std::uint8_t, kPairs>& first,
             const std::array<std::uint8_t, kPairs>& second, std::byte* row) {
  std::array<std::uint8_t, kPairs> is_less;
  for (std::size_t i = 0; i < kPairs; ++i) is_less[i] = first[i] < second[i] ? 1 : 0;
  for (std::size_t byte = 0; byte < OrbDescriptor::kBytes; ++byte) {
    std::uint64_t eight;  // one test a byte
    std::memcpy(&eight, &is_less[8 * byte], sizeof eight);
    // Shifts test i to bit 56 + i of the product.
    row[byte] = static_cast<std::byte>((eight * 0x0102040810204080U) >> 56U);
  }
}

}  // namespace

OrbDescriptor::OrbDescriptor()
    : pattern_(&OpenCvOrbPattern()), kernel_(cv::getGaussianKernel(7, /*sigma=*/2.0, CV_32F)) {}

// sepFilter2D and not GaussianBlur, which rounds differently from the path that cv::ORB takes.
cv::Mat OrbDescriptor::Smooth(const cv::Mat& level) {
  const std::size_t size = level.total();
  if (memory_.size() < size) memory_.resize(size);
  cv::Mat smooth(level.size(), CV_8UC1, memory_.data());
  cv::sepFilter2D(level, smooth, CV_8U, kernel_, kernel_, {-1, -1}, 0.0, cv::BORDER_REFLECT_101);
  return smooth;
}

void OrbDescriptor::Describe(const GrayImage& level, std::span<const OrientedCorner> corners,
                             std::byte* rows) {
  if (corners.empty()) return;
  const cv::Mat smooth = Smooth(level.mat());
  const auto stride = static_cast<std::int32_t>(smooth.step);
  std::array<std::uint8_t, kPairs> first, second;
  for (const OrientedCorner& corner : corners) {
    const std::uint8_t* center = smooth.ptr<std::uint8_t>(corner.y) + corner.x;
    const Rotation rotation = MakeRotation(corner.angle_rad);
    Sample(center, stride, rotation, pattern_->first_x, pattern_->first_y, first);
    Sample(center, stride, rotation, pattern_->second_x, pattern_->second_y, second);
    Compare(first, second, rows);
    rows += kBytes;
  }
}

}  // namespace lift_slam
