#pragma once

#include <torch/torch.h>

#include <vector>

#include "lift_slam/features/lift/lift_weights.h"

namespace lift_slam::training {

// Collects distances of descriptions that match and that do not.
class DistanceStatistics {
 public:
  // Of each of N first views to each of the N second ones (N, N), of which row and column i match;
  // and which are surely different points (N, N, bool).
  void Add(const torch::Tensor& distances, const torch::Tensor& different);

  // Share of the distances between different points up to that which 95 % of the matches keep.
  double FalsePositiveRate95() const;
  // Share of the matches that are nearer than any different point of their batch; equal distances,
  // as of a network that says the same of everything, are not nearer.
  double NearestCorrect() const;
  DistanceQuantiles Quantiles() const;

 private:
  std::vector<float> matching_, nearest_wrong_, different_;
};

}  // namespace lift_slam::training
