#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/features/quality_tables.h"

namespace lift_slam {

// Of one feature: percent of its matches within each threshold.
struct AccuracyCurve {
  std::string name;
  std::vector<double> thresholds_px, percent;
};

// Copies of each set's first images, changed in one way at a time (gamma, blur, turn, scale,
// slant), of which the true homography is known. The first table has for each change, in percent:
// repeatability (of the features seen in both images, those found again within 3 px), matching
// score (of the same, those whose mutual nearest neighbour is within 3 px) and homography accuracy
// (images whose corners the homography from the matches moves by less than 3 px). The second has
// the mean matching accuracy: of all mutual nearest neighbours those within so many pixels. For
// ORB, SIFT and all weights. What the second table shows is added to `curves`.
std::string HomographyTables(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                             const QualityOptions& options, std::vector<AccuracyCurve>& curves);

}  // namespace lift_slam
