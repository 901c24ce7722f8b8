#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "lift_slam/nn/aligned_vector.h"

namespace lift_slam::nn {

// Samples, channels, rows, columns.
struct Shape {
  int n = 1, c = 1, h = 1, w = 1;

  std::size_t size() const { return static_cast<std::size_t>(n) * sample_size(); }
  std::size_t sample_size() const {
    return static_cast<std::size_t>(c) * static_cast<std::size_t>(h) * static_cast<std::size_t>(w);
  }
  bool operator==(const Shape&) const = default;
};

// "1x32x29x29"
std::string ToString(const Shape& shape);

// Floats in NCHW order (w runs fastest), owned, 64-byte aligned; zero when made from a shape.
// Weights of a convolution are one of these too: n output channels, c input channels, h x w taps.
class Tensor {
 public:
  Tensor() : Tensor(Shape{0, 0, 0, 0}) {}
  explicit Tensor(const Shape& shape) : shape_(shape), values_(shape.size()) {}
  // Copies; CheckError unless values.size() == shape.size().
  Tensor(const Shape& shape, std::span<const float> values);

  const Shape& shape() const { return shape_; }
  std::size_t size() const { return values_.size(); }
  float* data() { return values_.data(); }
  const float* data() const { return values_.data(); }
  std::span<float> values() { return values_; }
  std::span<const float> values() const { return values_; }

  float& at(int n, int c, int y, int x) { return values_[Index(n, c, y, x)]; }
  float at(int n, int c, int y, int x) const { return values_[Index(n, c, y, x)]; }

 private:
  std::size_t Index(int n, int c, int y, int x) const {
    const auto rows = (static_cast<std::size_t>(n) * static_cast<std::size_t>(shape_.c) +
                       static_cast<std::size_t>(c)) *
                          static_cast<std::size_t>(shape_.h) +
                      static_cast<std::size_t>(y);
    return rows * static_cast<std::size_t>(shape_.w) + static_cast<std::size_t>(x);
  }

  Shape shape_;
  AlignedVector<float> values_;
};

}  // namespace lift_slam::nn
