#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lift_slam/features/lift/measurement/keypoint_pairs.h"

namespace lift_slam {

// What a file of weights says of itself beside the parameters. All the same for the same input and
// seed.

// LiftWeights::descriptor_ranges over patches of the weights' own keypoints in these images, half
// of them with a gamma of 1/2 to 2; about 0.1 s a patch. Flat patches are left out. Throws
// InputError when the images have no keypoints.
std::vector<float> MeasureRangesOnImages(const LiftWeights& weights,
                                         std::span<const GrayImage> images, int num_patches,
                                         std::uint64_t seed);

struct DistanceMeasurement {
  int warps_per_image = 2;
  int max_pairs = 500;  // of keypoints, an image pair
  WarpOptions warp = {};
  bool upright = true;
  std::uint64_t seed = 0;
  int num_threads = 1;
};

struct MeasuredDistances {
  DistanceQuantiles quantiles;
  std::size_t num_pairs = 0;  // of keypoints
};

// LiftWeights::distances over warped copies of images (the weights' own keypoints) and over pairs
// of photographs of one scene (SIFT's keypoints and verified matches). Throws InputError when fewer
// than 100 pairs of keypoints are found, and for weights without orientation unless upright.
MeasuredDistances MeasureDistances(const LiftWeights& weights, std::span<const GrayImage> images,
                                   std::span<const std::pair<GrayImage, GrayImage>> pairs,
                                   const DistanceMeasurement& options);

}  // namespace lift_slam
