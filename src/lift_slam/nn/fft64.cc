#include "lift_slam/nn/fft64.h"

#include <array>
#include <cmath>
#include <numbers>

namespace lift_slam::nn {
namespace {

using Vector = float __attribute__((vector_size(32)));

// exp(-2 pi i n / 64) for n = 0..63.
struct Twiddles {
  std::array<float, kFftSize> cosine, sine;

  Twiddles() {
    for (int n = 0; n < kFftSize; ++n) {
      const double angle = -2.0 * std::numbers::pi * n / kFftSize;
      cosine[static_cast<std::size_t>(n)] = static_cast<float>(std::cos(angle));
      sine[static_cast<std::size_t>(n)] = static_cast<float>(std::sin(angle));
    }
  }
};

const Twiddles& TwiddleTable() {
  static const Twiddles table;
  return table;
}

inline void MultiplyInto(const Twiddles& twiddles, int n, Vector real, Vector imaginary,
                         Vector& out_real, Vector& out_imaginary) {
  const float c = twiddles.cosine[static_cast<std::size_t>(n)];
  const float s = twiddles.sine[static_cast<std::size_t>(n)];
  out_real = real * c - imaginary * s;
  out_imaginary = real * s + imaginary * c;
}

// All butterflies of one stage; blocks of `length` values.
template <int length>
inline void Stage(const Twiddles& twiddles, Vector* real, Vector* imaginary) {
  constexpr int kQuarter = length / 4, kStep = kFftSize / length;
  for (int j = 0; j < kQuarter; ++j) {
    for (int block = 0; block < kFftSize; block += length) {
      Vector* r = real + block + j;
      Vector* i = imaginary + block + j;
      const Vector sum_r = r[0] + r[2 * kQuarter], sum_i = i[0] + i[2 * kQuarter];
      const Vector difference_r = r[0] - r[2 * kQuarter], difference_i = i[0] - i[2 * kQuarter];
      const Vector odd_sum_r = r[kQuarter] + r[3 * kQuarter];
      const Vector odd_sum_i = i[kQuarter] + i[3 * kQuarter];
      const Vector odd_difference_r = r[kQuarter] - r[3 * kQuarter];
      const Vector odd_difference_i = i[kQuarter] - i[3 * kQuarter];
      r[0] = sum_r + odd_sum_r;
      i[0] = sum_i + odd_sum_i;
      // Minus, then plus, the imaginary unit times the odd difference.
      MultiplyInto(twiddles, j * kStep, difference_r + odd_difference_i,
                   difference_i - odd_difference_r, r[kQuarter], i[kQuarter]);
      MultiplyInto(twiddles, 2 * j * kStep, sum_r - odd_sum_r, sum_i - odd_sum_i, r[2 * kQuarter],
                   i[2 * kQuarter]);
      MultiplyInto(twiddles, 3 * j * kStep, difference_r - odd_difference_i,
                   difference_i + odd_difference_r, r[3 * kQuarter], i[3 * kQuarter]);
    }
  }
}

// The last stage: no factors.
inline void LastStage(Vector* real, Vector* imaginary) {
  for (int block = 0; block < kFftSize; block += 4) {
    Vector* r = real + block;
    Vector* i = imaginary + block;
    const Vector sum_r = r[0] + r[2], sum_i = i[0] + i[2];
    const Vector difference_r = r[0] - r[2], difference_i = i[0] - i[2];
    const Vector odd_sum_r = r[1] + r[3], odd_sum_i = i[1] + i[3];
    const Vector odd_difference_r = r[1] - r[3], odd_difference_i = i[1] - i[3];
    r[0] = sum_r + odd_sum_r, i[0] = sum_i + odd_sum_i;
    r[1] = difference_r + odd_difference_i, i[1] = difference_i - odd_difference_r;
    r[2] = sum_r - odd_sum_r, i[2] = sum_i - odd_sum_i;
    r[3] = difference_r - odd_difference_i, i[3] = difference_i + odd_difference_r;
  }
}

}  // namespace

void Fft64(Vector* real, Vector* imaginary) {
  const Twiddles& twiddles = TwiddleTable();
  Stage<64>(twiddles, real, imaginary);
  Stage<16>(twiddles, real, imaginary);
  LastStage(real, imaginary);
}

}  // namespace lift_slam::nn
