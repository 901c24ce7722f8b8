#include "lift_slam/nn/half_float.h"

#include <algorithm>
#include <cmath>

namespace lift_slam::nn {

float FromHalf(std::uint16_t bits) {
  const int exponent = (bits >> 10) & 0x1F;
  const int fraction = bits & 0x3FF;
  const float sign = (bits & 0x8000) != 0 ? -1.0F : 1.0F;
  if (exponent == 0x1F) return std::nanf("");
  if (exponent == 0) return sign * std::ldexp(static_cast<float>(fraction), -24);
  return sign * std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
}

std::uint16_t ToHalf(float value) {
  constexpr int kInfinity = 0x7C00;
  constexpr int kSmallestExponent = -14;  // of numbers with all their digits
  const int sign = std::signbit(value) ? 0x8000 : 0;
  const float size = std::abs(value);
  if (!(size < 65520.0F)) return static_cast<std::uint16_t>(sign | kInfinity);
  // In steps of a number's last digit the bits count up through all numbers in order.
  const int exponent =
      size == 0.0F ? kSmallestExponent : std::max(std::ilogb(size), kSmallestExponent);
  const int steps = static_cast<int>(std::nearbyint(std::ldexp(size, 10 - exponent)));
  return static_cast<std::uint16_t>(sign | (steps + (exponent - kSmallestExponent) * 1024));
}

}  // namespace lift_slam::nn
