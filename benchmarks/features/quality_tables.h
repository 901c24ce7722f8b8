#pragma once

#include <span>
#include <string>
#include <vector>

#include "benchmarks/features/image_sets.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/nn/precision.h"

namespace lift_slam {

// Each returns a Markdown table. Weights without an orientation network are used upright, others
// both ways.

struct NamedWeights {
  std::string name;  // of the file
  LiftWeights weights;
};

struct QualityOptions {
  std::vector<nn::Precision> precisions{nn::Precision::kFloat32};
  int max_features = 1000;
  int num_threads = 2;
};

// Descriptors on SIFT's keypoints and verified matches: false positives at 95 % recall among all
// wrong pairs, and the share whose nearest is the right one; "-" without such pairs.
std::string DescriptorTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                            const QualityOptions& options);

// Own keypoints and descriptors: inliers of the essential matrix among mutual nearest neighbours,
// and among the best 100. With ORB and SIFT.
std::string MatchingTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                          const QualityOptions& options);

// The share of the 500 best keypoints that are found again within 3 pixels in a warped copy, of
// those within it; with ORB and SIFT. `options.max_features` does not count.
std::string RepeatabilityTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                               const QualityOptions& options);

// Matching with other choices of keypoints: candidate_ratio, first level, levels of the maximum.
std::string KeypointChoiceTable(const NamedWeights& weights, std::span<const ImageSet> sets,
                                const QualityOptions& options);

// Largest and root mean square difference from float32 of the descriptors of given patches
// (64 x 64, one after the other).
std::string PrecisionTable(std::span<const NamedWeights> all, std::span<const std::uint8_t> patches,
                           const QualityOptions& options);

}  // namespace lift_slam
