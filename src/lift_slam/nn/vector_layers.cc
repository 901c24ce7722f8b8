#include "lift_slam/nn/vector_layers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "lift_slam/util/check.h"

namespace lift_slam::nn {
namespace {

constexpr int kLanes = 8;
using Vector = float __attribute__((vector_size(kLanes * sizeof(float))));

Vector Load(const float* source) {
  Vector v;
  std::memcpy(&v, source, sizeof v);
  return v;
}
void Store(const Vector& v, float* destination) { std::memcpy(destination, &v, sizeof v); }

// Eight channels, or one: the same code for both.
void LoadInto(Vector& v, const float* source) { v = Load(source); }
void LoadInto(float& v, const float* source) { v = *source; }
void StoreFrom(const Vector& v, float* destination) { Store(v, destination); }
void StoreFrom(float v, float* destination) { *destination = v; }
Vector Maximum(const Vector& a, const Vector& b) { return a > b ? a : b; }
float Maximum(float a, float b) { return std::max(a, b); }
Vector Root(Vector v) {
  for (int i = 0; i < kLanes; ++i) v[i] = std::sqrt(v[i]);
  return v;
}
float Root(float v) { return std::sqrt(v); }

template <PoolingKind kind, class Value>
void PoolRow(const float* in, std::ptrdiff_t row_stride, std::ptrdiff_t column_stride, int window,
             float* out, std::ptrdiff_t out_column_stride, int out_width) {
  const float scale = 1.0F / static_cast<float>(window * window);
  for (int x = 0; x < out_width; ++x, out += out_column_stride, in += window * column_stride) {
    Value result = Value{};
    if constexpr (kind == PoolingKind::kMax) LoadInto(result, in);
    for (int dy = 0; dy < window; ++dy) {
      const float* pixel = in + dy * row_stride;
      for (int dx = 0; dx < window; ++dx, pixel += column_stride) {
        Value v;
        LoadInto(v, pixel);
        if constexpr (kind == PoolingKind::kMax) result = Maximum(result, v);
        if constexpr (kind == PoolingKind::kAverage) result += v;
        if constexpr (kind == PoolingKind::kL2) result += v * v;
      }
    }
    if constexpr (kind == PoolingKind::kAverage) result *= scale;
    if constexpr (kind == PoolingKind::kL2) result = Root(result);
    StoreFrom(result, out);
  }
}

template <PoolingKind kind>
void Pool(int window, const ChannelLayout& in, const float* source, const ChannelLayout& out,
          float* destination) {
  for (int y = 0; y < out.shape.h; ++y) {
    for (int c = 0; c < out.shape.c;) {
      const bool wide = in.Contiguous(c, kLanes) && out.Contiguous(c, kLanes);
      const auto pool_row = wide ? PoolRow<kind, Vector> : PoolRow<kind, float>;
      pool_row(source + in.Offset(c, y * window, 0), in.row_stride, in.column_stride, window,
               destination + out.Offset(c, y, 0), out.column_stride, out.shape.w);
      c += wide ? kLanes : 1;
    }
  }
}

std::vector<float> InverseCoverage(const Tensor& kernel, const Shape& shape) {
  const int radius = kernel.shape().h / 2;
  std::vector<float> inverse;
  for (int y = 0; y < shape.h; ++y) {
    for (int x = 0; x < shape.w; ++x) {
      double sum = 0.0;
      for (int dy = std::max(-radius, -y); dy <= std::min(radius, shape.h - 1 - y); ++dy) {
        for (int dx = std::max(-radius, -x); dx <= std::min(radius, shape.w - 1 - x); ++dx) {
          sum += kernel.at(0, 0, dy + radius, dx + radius);
        }
      }
      inverse.push_back(static_cast<float>(1.0 / sum));
    }
  }
  return inverse;
}

// Correlates a map that has a frame of `radius` values around it; in place, top to bottom and left
// to right it would not work, so into `out` (height x width).
void Correlate(const Tensor& kernel, const float* framed, const Shape& shape, float* out) {
  const int size = kernel.shape().h;
  const std::ptrdiff_t framed_width = shape.w + size - 1;
  for (int y = 0; y < shape.h; ++y) {
    float* row = out + std::ptrdiff_t{y} * shape.w;
    std::fill(row, row + shape.w, 0.0F);
    for (int dy = 0; dy < size; ++dy) {
      for (int dx = 0; dx < size; ++dx) {
        const float tap = kernel.at(0, 0, dy, dx);
        const float* source = framed + (y + dy) * framed_width + dx;
        for (int x = 0; x < shape.w; ++x) row[x] += tap * source[x];
      }
    }
  }
}

}  // namespace

VectorLayer::VectorLayer(const Layer& layer, const ChannelLayout& input,
                         const ChannelLayout& output)
    : input_(input), output_(output) {
  LIFT_SLAM_CHECK(OutputShape(layer, input.shape) == output.shape, "{} from {} to {}",
                  LayerName(layer), ToString(input.shape), ToString(output.shape));
  std::visit(
      [this](const auto& kind) {
        if constexpr (std::is_constructible_v<Kind, decltype(kind)>) kind_ = kind;
      },
      layer);
  LIFT_SLAM_CHECK(!std::holds_alternative<Copy>(kind_), "{} is no vector layer", LayerName(layer));
  if (const auto* normalization = std::get_if<SubtractiveNormalization>(&kind_)) {
    const int frame = normalization->kernel.shape().h - 1;
    inverse_coverage_ = InverseCoverage(normalization->kernel, input.shape);
    scratch_size_ = inverse_coverage_.size() +
                    static_cast<std::size_t>((input.shape.h + frame) * (input.shape.w + frame));
  }
}

VectorLayer::VectorLayer(const ChannelLayout& input, const ChannelLayout& output)
    : kind_(Copy{}), input_(input), output_(output) {
  LIFT_SLAM_CHECK(input.shape == output.shape, "copy from {} to {}", ToString(input.shape),
                  ToString(output.shape));
}

void VectorLayer::Run(const float* input, float* output, float* scratch) const {
  std::visit([&](const auto& kind) { Apply(kind, input, output, scratch); }, kind_);
}

void VectorLayer::Apply(const Copy&, const float* in, float* out, float*) const {
  const Shape& shape = output_.shape;
  for (int c = 0; c < shape.c; ++c) {
    for (int y = 0; y < shape.h; ++y) {
      for (int x = 0; x < shape.w; ++x) out[output_.Offset(c, y, x)] = in[input_.Offset(c, y, x)];
    }
  }
}

void VectorLayer::Apply(const Activation& layer, const float* in, float* out, float*) const {
  const Shape& shape = output_.shape;
  for (int c = 0; c < shape.c; ++c) {
    for (int y = 0; y < shape.h; ++y) {
      for (int x = 0; x < shape.w; ++x) {
        const float v = in[input_.Offset(c, y, x)];
        out[output_.Offset(c, y, x)] =
            layer.kind == ActivationKind::kRelu ? std::max(0.0F, v) : std::tanh(v);
      }
    }
  }
}

void VectorLayer::Apply(const Ghh& layer, const float* in, float* out, float*) const {
  const Shape& shape = output_.shape;
  for (int unit = 0; unit < shape.c; ++unit) {
    for (int y = 0; y < shape.h; ++y) {
      for (int x = 0; x < shape.w; ++x) {
        int channel = unit * layer.num_sums * layer.num_maxima;
        float value = 0.0F;
        for (int s = 0; s < layer.num_sums; ++s) {
          float maximum = -std::numeric_limits<float>::infinity();
          for (int m = 0; m < layer.num_maxima; ++m, ++channel) {
            maximum = std::max(maximum, in[input_.Offset(channel, y, x)]);
          }
          value += s % 2 == 0 ? maximum : -maximum;
        }
        out[output_.Offset(unit, y, x)] = value;
      }
    }
  }
}

void VectorLayer::Apply(const Pooling& layer, const float* in, float* out, float*) const {
  switch (layer.kind) {
    case PoolingKind::kMax:
      return Pool<PoolingKind::kMax>(layer.window, input_, in, output_, out);
    case PoolingKind::kAverage:
      return Pool<PoolingKind::kAverage>(layer.window, input_, in, output_, out);
    case PoolingKind::kL2:
      return Pool<PoolingKind::kL2>(layer.window, input_, in, output_, out);
  }
}

void VectorLayer::ChannelMean(int radius, const float* in, float* mean) const {
  const Shape& shape = input_.shape;
  const std::ptrdiff_t framed_width = shape.w + 2 * radius;
  std::fill(mean, mean + framed_width * (shape.h + 2 * radius), 0.0F);
  for (int y = 0; y < shape.h; ++y) {
    for (int x = 0; x < shape.w; ++x) {
      Vector sums = {};
      float sum = 0.0F;
      for (int c = 0; c < shape.c;) {
        const float* pixel = in + input_.Offset(c, y, x);
        if (input_.Contiguous(c, kLanes)) {  // the padding is zero
          sums += Load(pixel);
          c += kLanes;
        } else {
          sum += *pixel;
          ++c;
        }
      }
      for (int i = 0; i < kLanes; ++i) sum += sums[i];
      mean[(y + radius) * framed_width + x + radius] = sum / static_cast<float>(shape.c);
    }
  }
}

void VectorLayer::Subtract(const float* in, const float* mean, float* out) const {
  const Shape& shape = input_.shape;
  for (int y = 0; y < shape.h; ++y) {
    for (int c = 0; c < shape.c;) {
      // The padding must stay zero.
      const bool wide =
          c + kLanes <= shape.c && input_.Contiguous(c, kLanes) && output_.Contiguous(c, kLanes);
      const float* source = in + input_.Offset(c, y, 0);
      float* destination = out + output_.Offset(c, y, 0);
      for (int x = 0; x < shape.w; ++x) {
        const float m = mean[std::ptrdiff_t{y} * shape.w + x];
        if (wide) {
          Store(Load(source) - m, destination);
        } else {
          *destination = *source - m;
        }
        source += input_.column_stride;
        destination += output_.column_stride;
      }
      c += wide ? kLanes : 1;
    }
  }
}

void VectorLayer::Apply(const SubtractiveNormalization& layer, const float* in, float* out,
                        float* scratch) const {
  float* framed = scratch + inverse_coverage_.size();
  ChannelMean(layer.kernel.shape().h / 2, in, framed);
  Correlate(layer.kernel, framed, input_.shape, scratch);
  for (std::size_t i = 0; i < inverse_coverage_.size(); ++i) scratch[i] *= inverse_coverage_[i];
  Subtract(in, scratch, out);
}

}  // namespace lift_slam::nn
