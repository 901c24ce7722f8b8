#pragma once

#include <torch/torch.h>

#include <string>

#include "lift_slam/features/lift/lift_weights.h"

namespace lift_slam::training {

// The three networks of LIFT for training, topology F, with the parameters' names of the weights
// file. Input (N, 1, H, W) grey values as they enter a network: (v - 128) / 128.

// 64 x 64 -> 128 values, not normalised.
struct DescriptorModule : torch::nn::Module {
  DescriptorModule();
  torch::Tensor forward(const torch::Tensor& patches);
  torch::nn::Conv2d conv1, conv2, conv3;
};

// 64 x 64 -> 2 values along (cos, sin) of the angle.
struct OrientationModule : torch::nn::Module {
  OrientationModule();
  torch::Tensor forward(const torch::Tensor& patches);
  torch::nn::Conv2d conv1, conv2, conv3;
  torch::nn::Linear fc1, fc2;
};

// H x W -> (H - 24) x (W - 24) scores.
struct DetectorModule : torch::nn::Module {
  DetectorModule();
  torch::Tensor forward(const torch::Tensor& images);
  torch::nn::Conv2d conv1;
};

// Generalised hinging hyperplanes over dimension 1, laid out [unit][4 sums][4 maxima].
torch::Tensor Ghh(const torch::Tensor& channels);

// (cos, sin), rows of length 1, of the orientation network's two values; a tiny length is no
// division by zero.
torch::Tensor UnitDirections(const torch::Tensor& outputs);

// Copies the parameters named "MODULE.*" between weights and a network.
void LoadParameters(LiftWeights& weights, const std::string& module, torch::nn::Module& network);
void StoreParameters(const torch::nn::Module& network, const std::string& module,
                     LiftWeights& weights);

// While it lives, convolutions compute in bfloat16 when `enabled` and the CPU has it.
class Bfloat16Scope {
 public:
  explicit Bfloat16Scope(bool enabled);
  ~Bfloat16Scope();
  Bfloat16Scope(const Bfloat16Scope&) = delete;
  Bfloat16Scope& operator=(const Bfloat16Scope&) = delete;

 private:
  bool enabled_;
};

}  // namespace lift_slam::training
