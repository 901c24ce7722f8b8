#include "lift_slam/nn/layers.h"

#include "lift_slam/util/check.h"

namespace lift_slam::nn {
namespace {

struct Namer {
  std::string_view operator()(const Convolution&) const { return "convolution"; }
  std::string_view operator()(const FullyConnected&) const { return "fully connected"; }
  std::string_view operator()(const Ghh&) const { return "GHH"; }
  std::string_view operator()(const Activation&) const { return "activation"; }
  std::string_view operator()(const Pooling&) const { return "pooling"; }
  std::string_view operator()(const SubtractiveNormalization&) const {
    return "subtractive normalization";
  }
};

struct ShapeMaker {
  Shape in;

  Shape operator()(const Convolution& layer) const {
    const Shape& k = layer.weights.shape();
    LIFT_SLAM_CHECK(k.n > 0 && layer.bias.size() == static_cast<std::size_t>(k.n),
                    "{} biases for convolution weights {}", layer.bias.size(), ToString(k));
    LIFT_SLAM_CHECK(k.c == in.c && k.h > 0 && k.w > 0 && k.h <= in.h && k.w <= in.w,
                    "convolution weights {} on an input {}", ToString(k), ToString(in));
    return {in.n, k.n, in.h - k.h + 1, in.w - k.w + 1};
  }
  Shape operator()(const FullyConnected& layer) const {
    const Shape& k = layer.weights.shape();
    LIFT_SLAM_CHECK(k.n > 0 && layer.bias.size() == static_cast<std::size_t>(k.n),
                    "{} biases for fully connected weights {}", layer.bias.size(), ToString(k));
    LIFT_SLAM_CHECK(k.sample_size() == in.sample_size() && k.h == 1 && k.w == 1,
                    "fully connected weights {} on an input {}", ToString(k), ToString(in));
    return {in.n, k.n, 1, 1};
  }
  Shape operator()(const Ghh& layer) const {
    LIFT_SLAM_CHECK(layer.num_sums > 0 && layer.num_maxima > 0, "GHH of {} sums, {} maxima",
                    layer.num_sums, layer.num_maxima);
    const int group = layer.num_sums * layer.num_maxima;
    LIFT_SLAM_CHECK(in.c % group == 0, "GHH in groups of {} on an input {}", group, ToString(in));
    return {in.n, in.c / group, in.h, in.w};
  }
  Shape operator()(const Activation&) const { return in; }
  Shape operator()(const Pooling& layer) const {
    LIFT_SLAM_CHECK(layer.window > 0 && layer.window <= in.h && layer.window <= in.w,
                    "pooling window {} on an input {}", layer.window, ToString(in));
    return {in.n, in.c, in.h / layer.window, in.w / layer.window};
  }
  Shape operator()(const SubtractiveNormalization& layer) const {
    const Shape& k = layer.kernel.shape();
    LIFT_SLAM_CHECK(k.n == 1 && k.c == 1 && k.h == k.w && k.h % 2 == 1,
                    "subtractive normalization kernel {}", ToString(k));
    return in;
  }
};

}  // namespace

std::string_view LayerName(const Layer& layer) { return std::visit(Namer{}, layer); }

Shape OutputShape(const Layer& layer, const Shape& input) {
  LIFT_SLAM_CHECK(input.n >= 0 && input.c > 0 && input.h > 0 && input.w > 0, "{} on an input {}",
                  LayerName(layer), ToString(input));
  return std::visit(ShapeMaker{input}, layer);
}

Shape OutputShape(const Network& network, const Shape& input) {
  Shape shape = input;
  for (const Layer& layer : network) shape = OutputShape(layer, shape);
  return shape;
}

}  // namespace lift_slam::nn
