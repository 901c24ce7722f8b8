#include "training/weights_calibration.h"

#include <cstddef>

#include "lift_slam/features/lift/lift_networks.h"
#include "training/distance_statistics.h"
#include "training/lift_modules.h"
#include "training/losses.h"
#include "training/training_stage.h"

namespace lift_slam::training {
namespace {

constexpr std::size_t kMedian = 2;  // of DistanceQuantiles

// Distances between patches as the sets have them, without noise or changes of light; those of
// points with one view are slanted and relit a little, else they would be equal.
DistanceQuantiles MeasureDistances(LiftWeights& weights, const std::vector<WeightedSet>& sets,
                                   int batches) {
  const ViewOptions views{.max_tilt = 1.4,
                          .max_perspective = 0.01,
                          .position_noise_sigmas = 0.1,
                          .scale_noise_octaves = 0.05,
                          .rotation_noise_deg = 2.0,
                          .turned_share = 0.0};
  const PhotometryOptions light{.max_gamma = 1.1,
                                .gamma_share = 0.0,
                                .max_gain = 1.1,
                                .max_offset = 5.0,
                                .max_noise = 2.0,
                                .blurred_share = 0.0};
  constexpr std::uint64_t kSeed = 70001;
  const PatchSampler sampler(sets, {}, views, light, kSeed);
  DescriptorModule descriptor;
  LoadParameters(weights, "descriptor", descriptor);
  const torch::NoGradGuard no_gradients;
  DistanceStatistics statistics;
  for (int i = 0; i < batches; ++i) {
    const PatchBatch batch = sampler.Draw(static_cast<std::uint64_t>(i));
    const auto first = descriptor.forward(PatchTensor(batch.first, batch.count, batch.size));
    const auto second = descriptor.forward(PatchTensor(batch.second, batch.count, batch.size));
    statistics.Add(AllDistances(first, second), DifferenceTensor(batch));
  }
  return statistics.Quantiles();
}

// Makes all distances `factor` times as large: after the last convolution come only a ReLU and
// means, and one factor for all of them tells points apart as before.
void ScaleDescriptors(LiftWeights& weights, double factor) {
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (!parameter.name.starts_with("descriptor.conv3.")) continue;
    for (float& value : parameter.values) value *= static_cast<float>(factor);
  }
}

void MeasureRanges(const std::vector<WeightedSet>& sets, int num_patches, LiftWeights& weights) {
  const PatchBatch batch = PatchSampler(sets, {.count = num_patches}, {}, {}, 1).Draw(0);
  weights.descriptor_ranges = MeasureDescriptorRanges(weights, batch.first);
}

template <class Change>
void ChangeQuantiles(DistanceQuantiles& quantiles, const Change& change) {
  for (std::size_t i = 0; i < quantiles.matching.size(); ++i) {
    quantiles.matching[i] *= change(&DistanceQuantiles::matching, i);
    quantiles.nearest_wrong[i] *= change(&DistanceQuantiles::nearest_wrong, i);
  }
}

// As above; and what was measured of them.
void ScaleMeasured(LiftWeights& weights, DistanceQuantiles& measured, double factor) {
  ScaleDescriptors(weights, factor);
  ChangeQuantiles(measured, [&](auto, std::size_t) { return static_cast<float>(factor); });
}

}  // namespace

void CalibrateDescriptor(const std::vector<WeightedSet>& sets, const CalibrationSize& size,
                         double nearest_wrong, LiftWeights& weights) {
  weights.distances = MeasureDistances(weights, sets, size.batches);
  if (nearest_wrong > 0.0) {
    ScaleMeasured(weights, *weights.distances,
                  nearest_wrong / weights.distances->nearest_wrong[kMedian]);
  }
  MeasureRanges(sets, size.range_patches, weights);
}

void CarryOverCalibration(const LiftWeights& from, const std::vector<WeightedSet>& sets,
                          const CalibrationSize& size, LiftWeights& weights) {
  LiftWeights original = from;
  const DistanceQuantiles before = MeasureDistances(original, sets, size.batches);
  DistanceQuantiles after = MeasureDistances(weights, sets, size.batches);
  ScaleMeasured(weights, after, before.nearest_wrong[kMedian] / after.nearest_wrong[kMedian]);
  weights.distances = after;
  if (from.distances) {
    weights.distances = from.distances;
    ChangeQuantiles(*weights.distances, [&](auto member, std::size_t i) {
      return (before.*member)[i] > 0.0F ? (after.*member)[i] / (before.*member)[i] : 1.0F;
    });
  }
  MeasureRanges(sets, size.range_patches, weights);
}

}  // namespace lift_slam::training
