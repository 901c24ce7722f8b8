#include "lift_slam/nn/reference_layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lift_slam::nn {
namespace {

// Calls visit(n, c, y, x) for every element of a shape.
template <class Visit>
void ForEachElement(const Shape& shape, Visit visit) {
  for (int n = 0; n < shape.n; ++n) {
    for (int c = 0; c < shape.c; ++c) {
      for (int y = 0; y < shape.h; ++y) {
        for (int x = 0; x < shape.w; ++x) visit(n, c, y, x);
      }
    }
  }
}

// One output value is a sum of products, in double so that it serves as the truth.
void Apply(const Convolution& layer, const Tensor& in, Tensor& out) {
  const Shape& k = layer.weights.shape();
  ForEachElement(out.shape(), [&](int n, int o, int y, int x) {
    double sum = layer.bias[static_cast<std::size_t>(o)];
    for (int c = 0; c < k.c; ++c) {
      for (int dy = 0; dy < k.h; ++dy) {
        const float* taps = &layer.weights.values()[0] +
                            ((static_cast<std::ptrdiff_t>(o) * k.c + c) * k.h + dy) * k.w;
        const float* row =
            in.data() +
            ((static_cast<std::ptrdiff_t>(n) * k.c + c) * in.shape().h + y + dy) * in.shape().w + x;
        for (int dx = 0; dx < k.w; ++dx) sum += static_cast<double>(taps[dx]) * row[dx];
      }
    }
    out.at(n, o, y, x) = static_cast<float>(sum);
  });
}

void Apply(const FullyConnected& layer, const Tensor& in, Tensor& out) {
  const std::size_t size = in.shape().sample_size();
  ForEachElement(out.shape(), [&](int n, int o, int, int) {
    double sum = layer.bias[static_cast<std::size_t>(o)];
    for (std::size_t i = 0; i < size; ++i) {
      sum += static_cast<double>(layer.weights.data()[static_cast<std::size_t>(o) * size + i]) *
             in.data()[static_cast<std::size_t>(n) * size + i];
    }
    out.at(n, o, 0, 0) = static_cast<float>(sum);
  });
}

void Apply(const Ghh& layer, const Tensor& in, Tensor& out) {
  ForEachElement(out.shape(), [&](int n, int unit, int y, int x) {
    float value = 0.0F;
    for (int s = 0; s < layer.num_sums; ++s) {
      float maximum = -std::numeric_limits<float>::infinity();
      for (int m = 0; m < layer.num_maxima; ++m) {
        const int channel = (unit * layer.num_sums + s) * layer.num_maxima + m;
        maximum = std::max(maximum, in.at(n, channel, y, x));
      }
      value += s % 2 == 0 ? maximum : -maximum;
    }
    out.at(n, unit, y, x) = value;
  });
}

void Apply(const Activation& layer, const Tensor& in, Tensor& out) {
  for (std::size_t i = 0; i < in.size(); ++i) {
    const float v = in.data()[i];
    out.data()[i] = layer.kind == ActivationKind::kRelu ? std::max(0.0F, v) : std::tanh(v);
  }
}

void Apply(const Pooling& layer, const Tensor& in, Tensor& out) {
  ForEachElement(out.shape(), [&](int n, int c, int y, int x) {
    float maximum = -std::numeric_limits<float>::infinity();
    double sum = 0.0, squares = 0.0;
    for (int dy = 0; dy < layer.window; ++dy) {
      for (int dx = 0; dx < layer.window; ++dx) {
        const float v = in.at(n, c, y * layer.window + dy, x * layer.window + dx);
        maximum = std::max(maximum, v);
        sum += v;
        squares += static_cast<double>(v) * v;
      }
    }
    const double area = layer.window * layer.window;
    out.at(n, c, y, x) = layer.kind == PoolingKind::kMax ? maximum
                         : layer.kind == PoolingKind::kAverage
                             ? static_cast<float>(sum / area)
                             : static_cast<float>(std::sqrt(squares));
  });
}

void Apply(const SubtractiveNormalization& layer, const Tensor& in, Tensor& out) {
  const Shape& shape = in.shape();
  const int radius = layer.kernel.shape().h / 2;
  Tensor mean({shape.n, 1, shape.h, shape.w});
  ForEachElement(shape, [&](int n, int c, int y, int x) {
    mean.at(n, 0, y, x) += in.at(n, c, y, x) / static_cast<float>(shape.c);
  });
  ForEachElement(mean.shape(), [&](int n, int, int y, int x) {
    double sum = 0.0, coverage = 0.0;
    for (int dy = std::max(-radius, -y); dy <= std::min(radius, shape.h - 1 - y); ++dy) {
      for (int dx = std::max(-radius, -x); dx <= std::min(radius, shape.w - 1 - x); ++dx) {
        const double g = layer.kernel.at(0, 0, dy + radius, dx + radius);
        sum += g * mean.at(n, 0, y + dy, x + dx);
        coverage += g;
      }
    }
    for (int c = 0; c < shape.c; ++c) {
      out.at(n, c, y, x) = in.at(n, c, y, x) - static_cast<float>(sum / coverage);
    }
  });
}

}  // namespace

Tensor ApplyLayer(const Layer& layer, const Tensor& input) {
  Tensor output(OutputShape(layer, input.shape()));
  std::visit([&](const auto& kind) { Apply(kind, input, output); }, layer);
  return output;
}

Tensor ApplyNetwork(const Network& network, const Tensor& input) {
  Tensor tensor = input;
  for (const Layer& layer : network) tensor = ApplyLayer(layer, tensor);
  return tensor;
}

}  // namespace lift_slam::nn
