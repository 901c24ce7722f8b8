#pragma once

#include <torch/torch.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lift_slam/features/lift/lift_weights.h"
#include "training/patch_sampler.h"
#include "training/training_options.h"

namespace lift_slam::training {

// How good a network is on patches it was not trained on.
struct Validation {
  double figure = 0.0;                                    // less is better
  std::vector<std::pair<std::string, double>> details{};  // in a fixed order
};

// One of the three networks being trained while the others stay as they are.
class TrainingStage {
 public:
  virtual ~TrainingStage() = default;

  virtual PatchRequest request() const = 0;
  // The network, whose parameters change; the same object every time.
  virtual torch::nn::Module& network() = 0;
  // Of one batch, to be differentiated. `step` counts from 0.
  virtual torch::Tensor Loss(const PatchBatch& batch, std::int64_t step) = 0;
  virtual Validation Validate(const std::vector<PatchBatch>& batches) = 0;
};

// `weights` give the parameters to begin with, and the frozen networks.
std::unique_ptr<TrainingStage> MakeStage(Stage stage, const TrainingOptions& options,
                                         LiftWeights& weights);
std::unique_ptr<TrainingStage> MakeDescriptorStage(const TrainingOptions& options,
                                                   LiftWeights& weights);
std::unique_ptr<TrainingStage> MakeOrientationStage(const TrainingOptions& options,
                                                    LiftWeights& weights);
std::unique_ptr<TrainingStage> MakeDetectorStage(const TrainingOptions& options,
                                                 LiftWeights& weights);

// Patches as they enter a network: (count, 1, size, size), (v - 128) / 128.
torch::Tensor PatchTensor(const std::vector<std::uint8_t>& patches, int count, int size);
// PatchBatch::different as (count, count, bool).
torch::Tensor DifferenceTensor(const PatchBatch& batch);
// Rows of 2 numbers each as (count, 2).
torch::Tensor PositionTensor(const std::vector<float>& positions);

}  // namespace lift_slam::training
