#pragma once

#include <memory>
#include <vector>

#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/features/lift/keypoint_detection.h"
#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/features/lift/lift_options.h"
#include "lift_slam/features/lift/patch_cutter.h"

namespace lift_slam {

// LIFT (Yi et al., 2016): detector, even spread over the image, orientation, descriptor. A
// keypoint's level is round(5 log2 sigma), so that the scale of the level is its sigma in pixels.
// Features come in raster order.
class LiftExtractor : public FeatureExtractor {
 public:
  // Throws InputError for options out of range, and for weights without an orientation network
  // unless upright.
  LiftExtractor(const LiftWeights& weights, const LiftExtractorOptions& options);

  // Throws InputError for an image smaller than a patch (64 x 64).
  FeatureSet Extract(const GrayImage& image) override;
  const ScaleLevels& scale_levels() const override { return scale_levels_; }
  const DescriptorKind& descriptor_kind() const override { return kind_; }
  const ThresholdRange& thresholds() const override { return thresholds_; }
  bool has_fine_positions() const override { return true; }

  // When the descriptor runs in another precision than asked for.
  std::string Notice() const override;

  // Of the descriptor: what the CPU runs, and why it is not what was asked for.
  const nn::PrecisionChoice& precision() const { return networks_.precision(); }

 private:
  std::vector<LiftKeypoint> DetectSpread(const GrayImage& image);
  std::vector<float> Orient(const std::vector<LiftKeypoint>& keypoints);

  LiftExtractorOptions options_;
  LiftNetworks networks_;
  KeypointDetector detector_;
  PatchCutter cutter_;
  ScaleLevels scale_levels_;
  DescriptorKind kind_;
  ThresholdRange thresholds_;
};

std::unique_ptr<FeatureExtractor> CreateLiftExtractor(const LiftWeights& weights,
                                                      const LiftExtractorOptions& options);

// "lift:" and the SHA-256 of the weights (of their parameters when they were never saved), with
// ":upright" for patches that are not turned: what must agree for descriptors to be compared.
DescriptorKind LiftDescriptorKind(const LiftWeights& weights, bool upright);

// From the distances measured with the weights: the fixed ones are the 95 % quantile of those that
// match and 1.3 times the median of the nearest that do not. While tracking, the low one moves
// between those two and the high one from the latter to 1.3 times the 95 % quantile of those that
// do not match: a search around a prediction meets only a few of them. Without measured distances:
// the paper's, from 1 and 2 (EuRoC) to 2 and 3 (KITTI), fixed at 2, 3.
ThresholdRange LiftThresholds(const LiftWeights& weights, const LiftExtractorOptions& options);

}  // namespace lift_slam
