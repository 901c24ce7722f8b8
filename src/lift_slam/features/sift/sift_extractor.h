#pragma once

#include <memory>

#include "lift_slam/features/feature_extractor.h"

namespace lift_slam {

struct SiftOptions {
  int max_features = 1000;  // the strongest; 0: all that are found
  // Least contrast of a blob of the differences of Gaussians (OpenCV's scale).
  double contrast_threshold = 0.04;
};

// SIFT (Lowe, 2004) by OpenCV: the measure for other features, not made for sequences. A keypoint's
// level is 12 log2(sigma), so that the scale of the level is its sigma in pixels; those below 1
// pixel are on level 0. Any image size is accepted.
class SiftExtractor : public FeatureExtractor {
 public:
  // Throws InputError for options out of range.
  explicit SiftExtractor(const SiftOptions& options);

  FeatureSet Extract(const GrayImage& image) override;
  const ScaleLevels& scale_levels() const override { return scale_levels_; }
  const DescriptorKind& descriptor_kind() const override { return kind_; }
  const ThresholdRange& thresholds() const override { return thresholds_; }

 private:
  SiftOptions options_;
  ScaleLevels scale_levels_;
  DescriptorKind kind_{"sift", DescriptorMetric::kL2, 128};
  // About where matches and nearest wrong ones cross, of norm 512.
  ThresholdRange thresholds_{{200.0F, 300.0F}, {200.0F, 300.0F}, {250.0F, 350.0F}};
};

}  // namespace lift_slam
