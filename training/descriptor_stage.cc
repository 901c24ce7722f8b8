#include <algorithm>
#include <tuple>
#include <utility>

#include "training/distance_statistics.h"
#include "training/lift_modules.h"
#include "training/losses.h"
#include "training/training_stage.h"

namespace lift_slam::training {
namespace {

using torch::Tensor;

// Eq. 1 of the paper, or one of the later losses; orientation and position are the true ones.
class DescriptorStage : public TrainingStage {
 public:
  DescriptorStage(const TrainingOptions& options, LiftWeights& weights)
      : options_(options.descriptor), bfloat16_(options.run.bfloat16) {
    LoadParameters(weights, "descriptor", network_);
  }

  PatchRequest request() const override {
    const bool mines = options_.loss != DescriptorLoss::kHardest;
    return {.count = options_.schedule.batch * (mines ? options_.mining : 1)};
  }

  torch::nn::Module& network() override { return network_; }

  Tensor Loss(const PatchBatch& batch, std::int64_t step) override {
    Tensor patches = torch::cat({PatchTensor(batch.first, batch.count, batch.size),
                                 PatchTensor(batch.second, batch.count, batch.size)});
    const Tensor different = DifferenceTensor(batch);
    if (options_.loss == DescriptorLoss::kHardest) {
      const Tensor descriptions = Describe(patches);
      if (step >= options_.easy_steps) return RowLosses(descriptions, different).mean();
      const auto [first, second] = Halves(descriptions);
      return TripletLoss(first, second, different, 2.0 * options_.margin).mean();
    }
    return MinedLoss(patches, different);
  }

  Validation Validate(const std::vector<PatchBatch>& batches) override {
    const torch::NoGradGuard no_gradients;
    DistanceStatistics statistics;
    for (const PatchBatch& batch : batches) {
      const Tensor first = network_.forward(PatchTensor(batch.first, batch.count, batch.size));
      const Tensor second = network_.forward(PatchTensor(batch.second, batch.count, batch.size));
      statistics.Add(AllDistances(first, second), DifferenceTensor(batch));
    }
    const DistanceQuantiles quantiles = statistics.Quantiles();
    const double fpr95 = statistics.FalsePositiveRate95();
    return {fpr95 + 0.05 * (1.0 - statistics.NearestCorrect()),
            {{"fpr95_percent", 100.0 * fpr95},
             {"nearest_right_percent", 100.0 * statistics.NearestCorrect()},
             {"matching_median", quantiles.matching[2]},
             {"matching_95", quantiles.matching[4]},
             {"nearest_wrong_median", quantiles.nearest_wrong[2]}}};
  }

 private:
  // Both views of each point, the first ones first.
  Tensor Describe(const Tensor& patches) {
    const Bfloat16Scope scope(bfloat16_);
    return network_.forward(patches);
  }

  static std::pair<Tensor, Tensor> Halves(const Tensor& descriptions) {
    const std::int64_t n = descriptions.size(0) / 2;
    return {descriptions.slice(0, 0, n), descriptions.slice(0, n)};
  }

  Tensor RowLosses(const Tensor& descriptions, const Tensor& different) const {
    const auto [first, second] = Halves(descriptions);
    switch (options_.loss) {
      case DescriptorLoss::kPairs:
        return PairLoss(first, second, different, options_.margin);
      case DescriptorLoss::kTriplet:
        return TripletLoss(first, second, different, options_.margin);
      case DescriptorLoss::kHardest:
        break;
    }
    return HardestNegativeLoss(first, second, different, options_.margin);
  }

  // The worst of all examples, found without gradients, are computed again with them.
  Tensor MinedLoss(const Tensor& patches, const Tensor& different) {
    const std::int64_t n = patches.size(0) / 2, kept = options_.schedule.batch;
    Tensor losses;
    {
      const torch::NoGradGuard no_gradients;
      losses = RowLosses(Describe(patches), different);
    }
    const Tensor rows = std::get<1>(losses.reshape({-1, n}).sum(0).topk(std::min(n, kept)));
    const Tensor next = (rows + 1).remainder(n);
    const Tensor first = Describe(patches.index_select(0, rows));
    const Tensor second = Describe(patches.index_select(0, n + rows));
    const Tensor third = Describe(patches.index_select(0, n + next));
    const Tensor usable =
        different.index_select(0, rows).gather(1, next.unsqueeze(1)).squeeze(1).to(torch::kFloat32);
    const Tensor right = RowDistances(first, second);
    if (options_.loss == DescriptorLoss::kPairs) {
      const Tensor wrong = torch::relu(options_.margin - RowDistances(first, third));
      return (right + usable * wrong).mean();
    }
    const Tensor nearest = torch::min(RowDistances(first, third), RowDistances(second, third));
    return (torch::relu(options_.margin + right - nearest) * usable).mean();
  }

  DescriptorOptions options_;
  bool bfloat16_;
  DescriptorModule network_;
};

}  // namespace

std::unique_ptr<TrainingStage> MakeDescriptorStage(const TrainingOptions& options,
                                                   LiftWeights& weights) {
  return std::make_unique<DescriptorStage>(options, weights);
}

}  // namespace lift_slam::training
