#pragma once

#include <string>
#include <vector>

#include "lift_slam/features/descriptors.h"
#include "lift_slam/features/keypoint.h"
#include "lift_slam/image/image.h"

namespace lift_slam {

// Features of one image; keypoints[i] belongs to descriptors.row(i). In detection order, which is
// the same from run to run.
struct FeatureSet {
  std::vector<Keypoint> keypoints;
  Descriptors descriptors;
};

// The pyramid a detector works on: level i is scaled down by scale_factor^i.
struct ScaleLevels {
  int num_levels = 1;
  double scale_factor = 1.2;
  double sigma_px = 1.0;  // standard deviation of a position on level 0; grows with the scale

  double Scale(int level) const;  // scale_factor^level, >= 1
};

// Distances below which two descriptors are taken for the same point; in the kind's own metric.
struct MatchingThresholds {
  float low = 0.0F;   // TH_LOW: strict, wide search (paper sec. 3.4)
  float high = 0.0F;  // TH_HIGH: loose, guided search
};

// What the thresholds are, and how far they may be moved while tracking (paper sec. 3.4).
struct ThresholdRange {
  MatchingThresholds fixed;   // where they stay when nothing adapts them
  MatchingThresholds strict;  // the least: matches are plentiful
  MatchingThresholds loose;   // the most: tracking is about to be lost
  // Whether new map points are made with the moved TH_LOW too, or always with the strict one.
  bool moves_new_points = true;
};

// Finds and describes features. One object serves one thread.
class FeatureExtractor {
 public:
  virtual ~FeatureExtractor() = default;
  virtual FeatureSet Extract(const GrayImage& image) = 0;
  virtual const ScaleLevels& scale_levels() const = 0;
  virtual const DescriptorKind& descriptor_kind() const = 0;
  virtual const ThresholdRange& thresholds() const = 0;
  // Whether positions are found to a small part of a pixel, not on the pixels' grid.
  virtual bool has_fine_positions() const { return false; }
  // What the user should know, a sentence: such as an option that this machine cannot follow.
  virtual std::string Notice() const { return {}; }
};

}  // namespace lift_slam
