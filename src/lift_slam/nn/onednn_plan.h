#pragma once

#include <oneapi/dnnl/dnnl.hpp>
#include <optional>
#include <vector>

#include "lift_slam/nn/executor.h"
#include "lift_slam/nn/onednn_primitives.h"
#include "lift_slam/nn/vector_layers.h"

namespace lift_slam::nn {

// A piece of a network: a oneDNN primitive (perhaps none, at the beginning) and the vector layers
// that follow it. It takes `samples` at a time, so that what the primitive writes is still in the
// cache when the vector layers read it.
struct Stage {
  Shape input;      // of one sample
  int samples = 1;  // divides the plan's batch
  // float32, for `samples` of them; the primitive's own layout, but the first stage's is NCHW.
  dnnl::memory::desc input_desc;
  ChannelLayout input_layout;
  std::optional<WeightedPrimitive> primitive;
  std::optional<dnnl::reorder> convert;  // input_desc -> the primitive's source, where they differ
  std::vector<VectorLayer> layers;       // at least one; the last writes the next stage's input
};

// What all threads share; immutable.
struct Plan {
  dnnl::engine engine{dnnl::engine::kind::cpu, 0};
  int batch = 1;
  std::vector<Stage> stages;
};

Plan MakePlan(const Network& network, const Shape& input, const ExecutorOptions& options,
              Precision precision);

}  // namespace lift_slam::nn
