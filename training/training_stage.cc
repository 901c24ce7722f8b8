#include "training/training_stage.h"

namespace lift_slam::training {

using torch::Tensor;

std::unique_ptr<TrainingStage> MakeStage(Stage stage, const TrainingOptions& options,
                                         LiftWeights& weights) {
  switch (stage) {
    case Stage::kDescriptor:
      return MakeDescriptorStage(options, weights);
    case Stage::kOrientation:
      return MakeOrientationStage(options, weights);
    case Stage::kDetector:
      break;
  }
  return MakeDetectorStage(options, weights);
}

Tensor PatchTensor(const std::vector<std::uint8_t>& patches, int count, int size) {
  // Nobody writes to the tensor that shares the patches.
  auto* pixels = const_cast<std::uint8_t*>(patches.data());
  const Tensor grey = torch::from_blob(pixels, {count, 1, size, size}, torch::kUInt8);
  return (grey.to(torch::kFloat32) - 128.0) / 128.0;
}

Tensor DifferenceTensor(const PatchBatch& batch) {
  auto* values = const_cast<std::uint8_t*>(batch.different.data());
  return torch::from_blob(values, {batch.count, batch.count}, torch::kUInt8).to(torch::kBool);
}

Tensor PositionTensor(const std::vector<float>& positions) {
  auto* values = const_cast<float*>(positions.data());
  return torch::from_blob(values, {static_cast<std::int64_t>(positions.size()) / 2, 2},
                          torch::kFloat32)
      .clone();
}

}  // namespace lift_slam::training
