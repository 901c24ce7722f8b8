#pragma once

namespace lift_slam::nn {

inline constexpr int kFftSize = 64;

// Eight discrete Fourier transforms of length 64 side by side, in place:
// X[k] = sum over n of x[n] exp(-2 pi i n k / 64), found at DigitReversed(k). Exchanging `real` and
// `imaginary` gives the inverse, times 64. Radix 4, decimation in frequency.
void Fft64(float __attribute__((vector_size(32))) * real,
           float __attribute__((vector_size(32))) * imaginary);

// The number with its three base-4 digits in reverse; its own inverse.
constexpr int DigitReversed(int index) {
  return (index & 3) << 4 | (index & 12) | (index >> 4 & 3);
}

}  // namespace lift_slam::nn
