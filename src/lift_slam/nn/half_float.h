#pragma once

#include <cstdint>

namespace lift_slam::nn {

// IEEE 754 numbers of 16 bits. Infinities and NaN become NaN.
float FromHalf(std::uint16_t bits);

// The nearest (ties to even); beyond 65504, and for what is not finite, an infinity.
std::uint16_t ToHalf(float value);

}  // namespace lift_slam::nn
