#include "lift_slam/nn/tensor.h"

#include <fmt/format.h>

#include "lift_slam/util/check.h"

namespace lift_slam::nn {

std::string ToString(const Shape& shape) {
  return fmt::format("{}x{}x{}x{}", shape.n, shape.c, shape.h, shape.w);
}

Tensor::Tensor(const Shape& shape, std::span<const float> values)
    : shape_(shape), values_(values.begin(), values.end()) {
  LIFT_SLAM_CHECK(values.size() == shape.size(), "{} values for a tensor of shape {}",
                  values.size(), ToString(shape));
}

}  // namespace lift_slam::nn
