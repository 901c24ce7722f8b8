#include "lift_slam/nn/fft_filter_bank.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "lift_slam/nn/fft64.h"
#include "lift_slam/util/check.h"

namespace lift_slam::nn {
namespace {

constexpr int kLanes = 8;
constexpr int kFilters = 16;
constexpr std::size_t kArea = std::size_t{kFftSize} * kFftSize;

std::ptrdiff_t At(int row, int column) { return std::ptrdiff_t{row} * kFftSize + column; }

// Lane l < 4 holds filters 4 l and 4 l + 1 (real and imaginary part), lane 4 + l filters 4 l + 2
// and 4 l + 3: the two halves of the maximum of sum l.
int FilterOf(int lane, bool imaginary) {
  return 4 * (lane % 4) + 2 * (lane / 4) + (imaginary ? 1 : 0);
}

// Transforms the columns of a tile, eight at a time, and writes them as rows.
void TransformColumns(const float* real, const float* imaginary, float* out_real,
                      float* out_imaginary) {
  std::array<EightFloats, kFftSize> r, i;
  for (int column = 0; column < kFftSize; column += kLanes) {
    for (int y = 0; y < kFftSize; ++y) {
      std::memcpy(&r[static_cast<std::size_t>(y)], real + At(y, column), sizeof(EightFloats));
      std::memcpy(&i[static_cast<std::size_t>(y)], imaginary + At(y, column), sizeof(EightFloats));
    }
    Fft64(r.data(), i.data());
    for (int k = 0; k < kFftSize; ++k) {
      const auto position = static_cast<std::size_t>(DigitReversed(k));
      for (int lane = 0; lane < kLanes; ++lane) {
        out_real[At(column + lane, k)] = r[position][lane];
        out_imaginary[At(column + lane, k)] = i[position][lane];
      }
    }
  }
}

// A real tile, [x][y], and its spectrum, [frequency along x][frequency along y].
struct Spectrum {
  std::array<float, kArea> tile{}, real{}, imaginary{}, half_real{}, half_imaginary{}, zeros{};

  void Transform() {
    TransformColumns(tile.data(), zeros.data(), half_real.data(), half_imaginary.data());
    TransformColumns(half_real.data(), half_imaginary.data(), real.data(), imaginary.data());
  }
};

}  // namespace

struct FftFilterBank::Workspace {
  Spectrum spectrum;
  alignas(kAlignmentBytes) std::array<EightFloats, kFftSize> column_real, column_imaginary;
  // Rows of the result, still transformed along x: [y][column frequency].
  AlignedVector<EightFloats> rows_real{kArea}, rows_imaginary{kArea};
};

FftFilterBank::FftFilterBank(const Convolution& filters, float input_mean, float input_scale,
                             std::shared_ptr<WorkerTeam> team)
    : size_(filters.weights.shape().h),
      valid_(kFftSize - size_ + 1),
      input_mean_(input_mean),
      input_scale_(input_scale),
      team_(team != nullptr ? std::move(team) : std::make_shared<WorkerTeam>(1)),
      real_(kArea),
      imaginary_(kArea) {
  const Shape& shape = filters.weights.shape();
  LIFT_SLAM_CHECK(shape.n == kFilters && shape.c == 1 && shape.h == shape.w && size_ >= 2 &&
                      size_ <= kFftSize / 2 + 1 && filters.bias.size() == kFilters,
                  "a filter bank of weights {}", ToString(shape));
  TransformFilters(filters);
  for (int i = 0; i < team_->num_threads(); ++i) {
    workspaces_.push_back(std::make_unique<Workspace>());
  }
}

FftFilterBank::~FftFilterBank() = default;

// Correlation is multiplication with the conjugate spectrum W*. With filter a in the real and b in
// the imaginary part the factor is Wa* + i Wb*, whose inverse transform (of which the 1 / 64^2 is
// put in here) has the result of a as its real part and that of b as its imaginary part.
void FftFilterBank::TransformFilters(const Convolution& filters) {
  constexpr float kScale = 1.0F / static_cast<float>(kArea);
  const auto spectrum = std::make_unique<Spectrum>();
  for (int lane = 0; lane < kLanes; ++lane) {
    for (const bool imaginary : {false, true}) {
      const int filter = FilterOf(lane, imaginary);
      for (int y = 0; y < size_; ++y) {
        for (int x = 0; x < size_; ++x) {
          spectrum->tile[static_cast<std::size_t>(At(x, y))] =
              kScale * filters.weights.at(filter, 0, y, x);
        }
      }
      spectrum->Transform();
      for (std::size_t k = 0; k < kArea; ++k) {
        const float r = spectrum->real[k], i = spectrum->imaginary[k];
        real_[k][lane] += imaginary ? i : r;
        imaginary_[k][lane] += imaginary ? r : -i;
      }
      (imaginary ? imaginary_bias_ : real_bias_)[lane] =
          filters.bias[static_cast<std::size_t>(filter)];
    }
  }
}

void FftFilterBank::Run(const GreyPixels& image, float* scores) {
  LIFT_SLAM_CHECK(image.width >= size_ && image.height >= size_, "an image of {} x {}, filters {}",
                  image.width, image.height, size_);
  const int width = image.width - size_ + 1, height = image.height - size_ + 1;
  const int across = (width + valid_ - 1) / valid_, down = (height + valid_ - 1) / valid_;
  team_->ForEach(across * down, [&](int worker, int piece) {
    FilterTile(image, piece % across * valid_, piece / across * valid_,
               *workspaces_[static_cast<std::size_t>(worker)], scores);
  });
}

void FftFilterBank::LoadTile(const GreyPixels& image, int left, int top, float* tile) const {
  const int width = std::min(kFftSize, image.width - left);
  const int height = std::min(kFftSize, image.height - top);
  std::fill_n(tile, kArea, 0.0F);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* source = image.pixels + (top + y) * image.stride + left;
    for (int x = 0; x < width; ++x) {
      tile[At(x, y)] = (static_cast<float>(source[x]) - input_mean_) / input_scale_;
    }
  }
}

void FftFilterBank::MultiplyAndInvertColumn(int column, Workspace& space) const {
  const EightFloats* filter_real = &real_[0] + At(column, 0);
  const EightFloats* filter_imaginary = &imaginary_[0] + At(column, 0);
  const float* image_real = space.spectrum.real.data() + At(column, 0);
  const float* image_imaginary = space.spectrum.imaginary.data() + At(column, 0);
  EightFloats* real = space.column_real.data();
  EightFloats* imaginary = space.column_imaginary.data();
  for (int k = 0; k < kFftSize; ++k) {
    real[k] = filter_real[k] * image_real[k] - filter_imaginary[k] * image_imaginary[k];
    imaginary[k] = filter_imaginary[k] * image_real[k] + filter_real[k] * image_imaginary[k];
  }
  Fft64(imaginary, real);
  for (int y = 0; y < valid_; ++y) {
    space.rows_real[static_cast<std::size_t>(At(y, column))] = real[DigitReversed(y)];
    space.rows_imaginary[static_cast<std::size_t>(At(y, column))] = imaginary[DigitReversed(y)];
  }
}

void FftFilterBank::WriteRow(const EightFloats* real, const EightFloats* imaginary, int count,
                             float* scores) const {
  for (int x = 0; x < count; ++x) {
    const EightFloats a = real[DigitReversed(x)] + real_bias_;
    const EightFloats b = imaginary[DigitReversed(x)] + imaginary_bias_;
    const EightFloats maximum = a > b ? a : b;
    const auto largest = [&](int sum) { return std::max(maximum[sum], maximum[sum + 4]); };
    scores[x] = largest(0) - largest(1) + largest(2) - largest(3);
  }
}

void FftFilterBank::FilterTile(const GreyPixels& image, int left, int top, Workspace& space,
                               float* scores) const {
  LoadTile(image, left, top, space.spectrum.tile.data());
  space.spectrum.Transform();
  for (int column = 0; column < kFftSize; ++column) MultiplyAndInvertColumn(column, space);
  const int width = image.width - size_ + 1;
  const int columns = std::min(valid_, width - left);
  const int rows = std::min(valid_, image.height - size_ + 1 - top);
  for (int y = 0; y < rows; ++y) {
    EightFloats* real = &space.rows_real[0] + At(y, 0);
    EightFloats* imaginary = &space.rows_imaginary[0] + At(y, 0);
    Fft64(imaginary, real);
    WriteRow(real, imaginary, columns, scores + std::ptrdiff_t{top + y} * width + left);
  }
}

}  // namespace lift_slam::nn
