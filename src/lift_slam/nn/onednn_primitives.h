#pragma once

#include <oneapi/dnnl/dnnl.hpp>
#include <optional>

#include "lift_slam/nn/channel_layout.h"
#include "lift_slam/nn/layers.h"
#include "lift_slam/nn/precision.h"

namespace lift_slam::nn {

// How one convolution or fully connected layer is to be computed.
struct PrimitiveRequest {
  Shape input;                               // with n samples at a time
  std::optional<ActivationKind> activation;  // fused
  Precision precision = Precision::kFloat32;
  float activation_range = 0.0F;   // int8: largest absolute input
  bool nonnegative_input = false;  // int8: uses all 256 steps for it
};

// A oneDNN primitive with its weights in the order it likes best. Input of its own type and layout
// (`source`), float32 output. May run in several threads at once, each with its own memory.
struct WeightedPrimitive {
  dnnl::primitive primitive;
  dnnl::memory weights, bias;
  dnnl::memory::desc source, destination, scratchpad;
  float source_scale = 1.0F;  // float32 input is multiplied by this before it is converted
};

// CheckError when oneDNN has nothing but its reference implementation, a thousand times slower.
WeightedPrimitive MakePrimitive(const Convolution& layer, const PrimitiveRequest& request,
                                const dnnl::engine& engine);
WeightedPrimitive MakePrimitive(const FullyConnected& layer, const PrimitiveRequest& request,
                                const dnnl::engine& engine);

// The same places in memory, float32.
dnnl::memory::desc AsFloat32(const dnnl::memory::desc& desc);
dnnl::memory::desc PlainDesc(const Shape& shape);
// Where the values of one sample lie. `shape` with its h and w (a 2-dimensional desc has none).
ChannelLayout LayoutOf(const dnnl::memory::desc& desc, const Shape& shape);

// Conversion between descriptions of the same values, times a scale.
dnnl::reorder MakeReorder(const dnnl::memory::desc& from, const dnnl::memory::desc& to, float scale,
                          const dnnl::engine& engine);

}  // namespace lift_slam::nn
