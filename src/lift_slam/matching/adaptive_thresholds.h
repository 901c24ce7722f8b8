#pragma once

#include "lift_slam/features/feature_extractor.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

enum class ThresholdMode { kFixed, kAdaptive };
inline constexpr std::string_view kThresholdModeNames[] = {"fixed", "adaptive"};

struct MatchingOptions {
  ThresholdMode thresholds = ThresholdMode::kAdaptive;
  // Matches of the last frame's points, less the outliers among them: from `plenty` up the
  // thresholds are strict, from `few` down they are loose, and in proportion between. Fewer than
  // `few` are near the number at which tracking gives up.
  int plenty = 200;
  int few = 60;
  // They grow at once, as a lost frame cannot be had again, and fall by at most this share of
  // their range a frame; a smaller change than the dead band is left out.
  double max_fall = 0.05;
  double dead_band = 0.05;

  void Visit(OptionVisitor& visitor);
  // Throws InputError naming the option that is out of range.
  void Check() const;
};

// Adaptive thresholds (paper sec. 3.4): they follow the difference between the map points of the
// last frame that were matched and the outliers among them. The paper shows the curve (Fig. 5) and
// gives no formula; this one needs no number of the data set, as its bounds come from the features.
struct AdaptiveThresholds {
  double looseness = 0.0;  // 0: strict, 1: loose

  // Between the strict and the loose ones; the fixed ones when not adaptive.
  MatchingThresholds In(const ThresholdRange& range, ThresholdMode mode) const;
};

// The state after a frame in which so many matches had so many outliers. num_outliers <= matches.
AdaptiveThresholds Adapt(const AdaptiveThresholds& current, const MatchingOptions& options,
                         int num_matches, int num_outliers);

}  // namespace lift_slam
