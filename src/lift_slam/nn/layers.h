#pragma once

#include <string_view>
#include <variant>
#include <vector>

#include "lift_slam/nn/tensor.h"

namespace lift_slam::nn {

// Layers are data; what they compute is in reference_layers.h. Each takes a tensor (N, C, H, W) and
// gives one with the same N.

// Cross-correlation (no kernel flip), stride 1, no padding: (O, H - kh + 1, W - kw + 1).
struct Convolution {
  Tensor weights;           // (O, I, kh, kw)
  std::vector<float> bias;  // O values
};

// Flattens C, H, W in this order and multiplies: (O, 1, 1).
struct FullyConnected {
  Tensor weights;           // (O, C * H * W, 1, 1)
  std::vector<float> bias;  // O values
};

// Generalised hinging hyperplanes. Channels are laid out [unit][sum][maximum], maximum fastest:
// out_u = sum_s delta_s * max_m x[u, s, m], delta = +1, -1, +1, -1...
struct Ghh {
  int num_sums = 4;
  int num_maxima = 4;
};

enum class ActivationKind { kRelu, kTanh };
struct Activation {
  ActivationKind kind = ActivationKind::kRelu;
};

// Square windows that touch but do not overlap; an incomplete window at the right or bottom is
// dropped. kL2 is the root of the SUM of squares.
enum class PoolingKind { kMax, kAverage, kL2 };
struct Pooling {
  PoolingKind kind = PoolingKind::kMax;
  int window = 2;
};

// Subtracts one local mean from all channels: m(y, x) = sum over the kernel of
// G * mean_c x / coverage(y, x), zero outside the map; coverage is the part of the kernel inside.
struct SubtractiveNormalization {
  Tensor kernel;  // (1, 1, k, k), k odd, non-negative, sum 1
};

using Layer =
    std::variant<Convolution, FullyConnected, Ghh, Activation, Pooling, SubtractiveNormalization>;
using Network = std::vector<Layer>;

std::string_view LayerName(const Layer& layer);

// The shape a layer makes of an input; CheckError when they do not fit together.
Shape OutputShape(const Layer& layer, const Shape& input);
Shape OutputShape(const Network& network, const Shape& input);

}  // namespace lift_slam::nn
