#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/features/orb/corner_distribution.h"
#include "lift_slam/features/orb/fast_corners.h"
#include "lift_slam/features/orb/orb_descriptor.h"
#include "lift_slam/features/orb/orb_options.h"
#include "lift_slam/image/pyramid.h"

namespace lift_slam {

// ORB (Rublee et al., 2011) with corners spread evenly over the image: on each pyramid level FAST
// corners, their even spread, orientation, descriptor. Features come level by level, in raster
// order within a level. Any image size up to 32767 pixels a side is accepted: what
// is too small to describe gives none.
class OrbExtractor : public FeatureExtractor {
 public:
  // Throws InputError for options out of range.
  explicit OrbExtractor(const OrbOptions& options);

  FeatureSet Extract(const GrayImage& image) override;
  const ScaleLevels& scale_levels() const override { return scale_levels_; }
  const DescriptorKind& descriptor_kind() const override { return kind_; }
  const ThresholdRange& thresholds() const override { return thresholds_; }

 private:
  struct LevelFeatures {
    std::vector<Keypoint> keypoints;
    std::vector<std::byte> descriptors;
  };
  // Memory kept from image to image, one for each thread.
  struct Scratch {
    FastScoreMap scores;
    std::vector<Corner> corners;
    OrbDescriptor descriptor;
  };

  std::vector<LevelFeatures> ExtractLevels(const ImagePyramid& pyramid,
                                           const std::vector<int>& counts);
  LevelFeatures ExtractLevel(const PyramidLevel& level, int level_index, int count,
                             Scratch& scratch) const;
  std::vector<Corner> DetectCorners(const GrayImage& image, int count, Scratch& scratch) const;

  OrbOptions options_;
  ScaleLevels scale_levels_;
  DescriptorKind kind_{"orb", DescriptorMetric::kHamming, OrbDescriptor::kBits};
  // ORB-SLAM's limits for 256-bit descriptors.
  // Of 256 bits: ORB-SLAM's, and what they become when tracking is about to be lost.
  ThresholdRange thresholds_{{50.0F, 100.0F}, {50.0F, 100.0F}, {65.0F, 115.0F}};
  ImagePyramid pyramid_;  // of the last image; its memory is used again
  std::vector<Scratch> scratch_;
};

std::unique_ptr<FeatureExtractor> CreateOrbExtractor(const OrbOptions& options);

// All that decides what the features of an image are, for FeatureCache: equal for options that only
// change times or what is made of the features.
std::string OrbIdentity(OrbOptions options);

}  // namespace lift_slam
