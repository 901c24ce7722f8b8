#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lift_slam/features/lift/lift_networks.h"
#include "lift_slam/features/lift/measurement/keypoint_pairs.h"

namespace lift_slam {

// 128 values a keypoint; patches are turned by the orientation network unless upright.
std::vector<float> DescribeKeypoints(const GrayImage& image,
                                     std::span<const LiftKeypoint> keypoints, bool upright,
                                     LiftNetworks& networks);

// Euclidean distances between the descriptors of pairs of keypoints.
struct DistanceSamples {
  std::vector<float> matching;       // of each pair
  std::vector<float> nearest_wrong;  // of each first keypoint and the nearest that shows elsewhere
  std::vector<float> wrong;          // of each first keypoint and all that show elsewhere
  std::size_t num_nearest_is_right = 0;
};

// Appends those of one image pair; `a` and `b` hold the descriptors in the order of the pairs.
// "Elsewhere" is 2 sigma and more away: descriptors of neighbours resemble each other rightly.
void AppendDistances(const KeypointPairs& pairs, std::span<const float> a, std::span<const float> b,
                     DistanceSamples& samples);

// Interpolated between the order statistics; `share` in [0, 1]. 0 without samples.
float Quantile(std::vector<float> samples, double share);

// The share of wrong pairs that are as near as 95 % of the matching ones; nothing without pairs of
// both kinds.
std::optional<double> FalsePositiveRateAt95(const DistanceSamples& samples);

// Of matching and nearest wrong distances.
DistanceQuantiles Quantiles(const DistanceSamples& samples);

}  // namespace lift_slam
