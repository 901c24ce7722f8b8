#include <cmath>
#include <numbers>

#include "training/lift_modules.h"
#include "training/losses.h"
#include "training/spatial_transformer.h"
#include "training/training_stage.h"

namespace lift_slam::training {
namespace {

using torch::Tensor;

constexpr std::int64_t kPatch = 64;
constexpr double kRatio = 0.5;  // of the patch that networks see to the one that is stored

// The orientation network, given the true positions and the trained descriptor.
class OrientationStage : public TrainingStage {
 public:
  OrientationStage(const TrainingOptions& options, LiftWeights& weights)
      : options_(options.orientation), bfloat16_(options.run.bfloat16) {
    LoadParameters(weights, "orientation", network_);
    LoadParameters(weights, "descriptor", descriptor_);
    for (Tensor& parameter : descriptor_.parameters()) parameter.set_requires_grad(false);
  }

  PatchRequest request() const override {
    return {.count = options_.schedule.batch,
            .size = 2 * static_cast<int>(kPatch),
            .half_width = 12.0,
            .max_shift = options_.max_shift_sigmas,
            .each_turned = true};
  }

  torch::nn::Module& network() override { return network_; }

  Tensor Loss(const PatchBatch& batch, std::int64_t) override {
    const Side first = Orient(batch, batch.first, batch.first_position);
    const Side second = Orient(batch, batch.second, batch.second_position);
    if (options_.loss == OrientationLoss::kAngles) {
      return (1.0 - CosineOfError(first, second, batch)).mean();
    }
    return DescriptorDistances(first, second).mean();  // Eq. 2
  }

  Validation Validate(const std::vector<PatchBatch>& batches) override {
    const torch::NoGradGuard no_gradients;
    std::vector<Tensor> cosines, distances;
    for (const PatchBatch& batch : batches) {
      const Side first = Orient(batch, batch.first, batch.first_position);
      const Side second = Orient(batch, batch.second, batch.second_position);
      cosines.push_back(CosineOfError(first, second, batch));
      distances.push_back(DescriptorDistances(first, second));
    }
    const Tensor error = torch::cat(cosines).clamp(-1.0, 1.0).acos() * (180.0 / std::numbers::pi);
    const auto distance = torch::cat(distances).mean().item<double>();
    const auto unlike = (1.0 - torch::cat(cosines)).mean().item<double>();
    const auto share_below = [&](double degrees) {
      return 100.0 * (error < degrees).to(torch::kFloat32).mean().item<double>();
    };
    return {options_.loss == OrientationLoss::kAngles ? unlike : distance,
            {{"median_error_deg", error.median().item<double>()},
             {"below_10_deg_percent", share_below(10.0)},
             {"below_20_deg_percent", share_below(20.0)},
             {"descriptor_distance", distance}}};
  }

 private:
  // One of the two views of the points.
  struct Side {
    Tensor patches, centres, directions;
  };

  Side Orient(const PatchBatch& batch, const std::vector<std::uint8_t>& pixels,
              const std::vector<float>& positions) {
    Side side{PatchTensor(pixels, batch.count, batch.size), PositionTensor(positions), {}};
    const Tensor upright = torch::tensor({1.0F, 0.0F}).expand({batch.count, 2});
    const Tensor seen = CutRotated(side.patches, side.centres, upright, kRatio, kPatch);
    side.directions = UnitDirections(network_.forward(seen));
    return side;
  }

  // Of the difference between the two angles and what it should be: a patch whose axes are turned
  // by a in the image sees its content at an angle smaller by a.
  static Tensor CosineOfError(const Side& first, const Side& second, const PatchBatch& batch) {
    Tensor turn = torch::tensor(batch.second_angle) - torch::tensor(batch.first_angle);
    const Tensor c = turn.cos(), s = turn.sin();
    const Tensor x = second.directions.select(1, 0), y = second.directions.select(1, 1);
    return first.directions.select(1, 0) * (c * x - s * y) +
           first.directions.select(1, 1) * (s * x + c * y);
  }

  Tensor Describe(const Side& side) {
    const Tensor turned = CutRotated(side.patches, side.centres, side.directions, kRatio, kPatch);
    const Bfloat16Scope scope(bfloat16_);
    return descriptor_.forward(turned);
  }

  Tensor DescriptorDistances(const Side& first, const Side& second) {
    return RowDistances(Describe(first), Describe(second));
  }

  OrientationOptions options_;
  bool bfloat16_;
  OrientationModule network_;
  DescriptorModule descriptor_;
};

}  // namespace

std::unique_ptr<TrainingStage> MakeOrientationStage(const TrainingOptions& options,
                                                    LiftWeights& weights) {
  return std::make_unique<OrientationStage>(options, weights);
}

}  // namespace lift_slam::training
