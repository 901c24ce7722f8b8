#pragma once

#include "lift_slam/nn/layers.h"

namespace lift_slam::nn {

// What the layers mean: plain loops over a tensor (N, C, H, W), written to be right by inspection.
Tensor ApplyLayer(const Layer& layer, const Tensor& input);
Tensor ApplyNetwork(const Network& network, const Tensor& input);

}  // namespace lift_slam::nn
