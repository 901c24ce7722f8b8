#pragma once

#include <cmath>
#include <vector>

#include "lift_slam/nn/layers.h"
#include "lift_slam/util/random.h"

namespace lift_slam::nn {

inline std::vector<float> RandomValues(std::size_t count, Random& random, double deviation = 1.0) {
  std::vector<float> values(count);
  for (float& v : values) v = static_cast<float>(deviation * random.Normal());
  return values;
}

inline Tensor RandomTensor(const Shape& shape, Random& random, double deviation = 1.0) {
  return {shape, RandomValues(shape.size(), random, deviation)};
}

// He initialisation, so that activations keep their size.
inline Convolution RandomConvolution(const Shape& weights, Random& random) {
  const double deviation = std::sqrt(2.0 / static_cast<double>(weights.sample_size()));
  return {RandomTensor(weights, random, deviation),
          RandomValues(static_cast<std::size_t>(weights.n), random, 0.1)};
}

inline FullyConnected RandomFullyConnected(int outputs, int inputs, Random& random) {
  Convolution layer = RandomConvolution({outputs, inputs, 1, 1}, random);
  return {std::move(layer.weights), std::move(layer.bias)};
}

inline SubtractiveNormalization GaussianNormalization(int size) {
  SubtractiveNormalization layer{Tensor({1, 1, size, size})};
  double sum = 0.0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double dy = y - size / 2, dx = x - size / 2;
      layer.kernel.at(0, 0, y, x) = static_cast<float>(std::exp(-0.3 * dx * dx - 0.25 * dy * dy));
      sum += layer.kernel.at(0, 0, y, x);
    }
  }
  for (float& v : layer.kernel.values()) v = static_cast<float>(v / sum);
  return layer;
}

}  // namespace lift_slam::nn
