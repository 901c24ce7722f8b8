#include "training/lift_modules.h"
#include "training/losses.h"
#include "training/spatial_transformer.h"
#include "training/training_stage.h"

namespace lift_slam::training {
namespace {

using torch::Tensor;

constexpr int kSmallPatch = 48;    // what the detector sees of 24 sigmas
constexpr int kLargePatch = 128;   // the same for the networks after it
constexpr std::int64_t kCrop = 5;  // of the 24 x 24 scores, so that the descriptor's patch, turned
constexpr double kFirstScore = 17.0;  // anyhow, stays inside: 14 x 14 from pixel 17 on
constexpr double kHalfPixels = 23.5;  // from the centre to the outermost of 48 pixels
constexpr double kRatio = 0.5;        // the descriptor's patch of 12 sigmas
constexpr double kHalfWidth = 12.0;   // sigmas

// The detector: first the overlap of its two detections, then (pair_steps) how alike they are
// described; always the classification of Eq. 4.
class DetectorStage : public TrainingStage {
 public:
  DetectorStage(const TrainingOptions& options, LiftWeights& weights)
      : options_(options.detector), bfloat16_(options.run.bfloat16) {
    LoadParameters(weights, "detector", network_);
    LoadParameters(weights, "orientation", orientation_);
    LoadParameters(weights, "descriptor", descriptor_);
    for (Tensor& p : orientation_.parameters()) p.set_requires_grad(false);
    for (Tensor& p : descriptor_.parameters()) p.set_requires_grad(false);
  }

  PatchRequest request() const override {
    return {.count = options_.schedule.batch,
            .size = options_.pair_steps > 0 ? kLargePatch : kSmallPatch,
            .half_width = kHalfWidth,
            .max_shift = options_.max_shift_sigmas,
            .min_sigma = options_.min_sigma,
            .with_empty = true};
  }

  torch::nn::Module& network() override { return network_; }

  Tensor Loss(const PatchBatch& batch, std::int64_t step) override {
    const Detection first = Detect(batch, batch.first), second = Detect(batch, batch.second);
    const Detection empty = Detect(batch, batch.empty);
    const Tensor classification =
        ClassificationLoss(first.scores, second.scores, first.scores.roll(-1, 0), empty.scores);
    const bool pairs = step >= options_.schedule.steps - options_.pair_steps;
    const Tensor agreement =
        pairs ? DescriptorDistances(first, second).mean() : Overlap(first, second, batch).mean();
    return agreement + options_.classification_weight * classification;
  }

  Validation Validate(const std::vector<PatchBatch>& batches) override {
    const torch::NoGradGuard no_gradients;
    double loss = 0.0, right = 0.0;
    std::vector<Tensor> gaps;
    for (const PatchBatch& batch : batches) {
      const Detection first = Detect(batch, batch.first), second = Detect(batch, batch.second);
      const Detection empty = Detect(batch, batch.empty);
      const Tensor classification =
          ClassificationLoss(first.scores, second.scores, first.scores.roll(-1, 0), empty.scores);
      loss +=
          (Overlap(first, second, batch).mean() + options_.classification_weight * classification)
              .item<double>();
      right += 0.5 * ((first.scores > 0).to(torch::kFloat32).mean() +
                      (empty.scores < 0).to(torch::kFloat32).mean())
                         .item<double>();
      gaps.push_back(kHalfWidth * RowDistances(Rebased(first, batch.first_position),
                                               Rebased(second, batch.second_position)));
    }
    const auto count = static_cast<double>(batches.size());
    const Tensor gap = torch::cat(gaps);
    return {loss / count,
            {{"loss", loss / count},
             {"median_gap_sigmas", gap.median().item<double>()},
             {"gap_below_1_sigma_percent",
              100.0 * (gap < 1.0).to(torch::kFloat32).mean().item<double>()},
             {"classified_right_percent", 100.0 * right / count}}};
  }

 private:
  struct Detection {
    Tensor patches;  // as given
    Tensor places;   // (N, 2), -1 to 1 across the patch
    Tensor scores;   // (N)
  };

  Detection Detect(const PatchBatch& batch, const std::vector<std::uint8_t>& pixels) {
    const Tensor patches = PatchTensor(pixels, batch.count, batch.size);
    Tensor seen = patches;
    if (batch.size != kSmallPatch) {
      seen = torch::nn::functional::interpolate(
          patches, torch::nn::functional::InterpolateFuncOptions()
                       .size(std::vector<std::int64_t>{kSmallPatch, kSmallPatch})
                       .mode(torch::kBilinear)
                       .align_corners(true));
    }
    const Tensor map = network_.forward(seen);
    const std::int64_t last = map.size(2) - kCrop;
    const Tensor scores = map.slice(2, kCrop, last).slice(3, kCrop, last);
    const Tensor places = (SoftArgmax(scores, options_.softness) + kFirstScore) / kHalfPixels - 1.0;
    return {patches, places, SoftMaximum(scores, options_.softness)};
  }

  static Tensor Rebased(const Detection& detection, const std::vector<float>& true_positions) {
    return detection.places - PositionTensor(true_positions);
  }

  Tensor Overlap(const Detection& first, const Detection& second, const PatchBatch& batch) const {
    return OverlapLoss(Rebased(first, batch.first_position), Rebased(second, batch.second_position),
                       kRatio);
  }

  Tensor Describe(const Detection& detection) {
    constexpr std::int64_t kPatch = 64;
    const Tensor upright = torch::tensor({1.0F, 0.0F}).expand({detection.places.size(0), 2});
    const Tensor seen = CutRotated(detection.patches, detection.places, upright, kRatio, kPatch);
    const Tensor directions = UnitDirections(orientation_.forward(seen));
    const Tensor turned =
        CutRotated(detection.patches, detection.places, directions, kRatio, kPatch);
    const Bfloat16Scope scope(bfloat16_);
    return descriptor_.forward(turned);
  }

  // Eq. 5.
  Tensor DescriptorDistances(const Detection& first, const Detection& second) {
    return RowDistances(Describe(first), Describe(second));
  }

  DetectorOptions options_;
  bool bfloat16_;
  DetectorModule network_;
  OrientationModule orientation_;
  DescriptorModule descriptor_;
};

}  // namespace

std::unique_ptr<TrainingStage> MakeDetectorStage(const TrainingOptions& options,
                                                 LiftWeights& weights) {
  return std::make_unique<DetectorStage>(options, weights);
}

}  // namespace lift_slam::training
