#pragma once

#include <torch/torch.h>

#include <vector>

#include "lift_slam/features/lift/lift_weights.h"

namespace lift_slam::training {

// Collects distances of descriptions that match and that do not.
class DistanceStatistics {
 public:
  // Of N pairs that match (N); of each first view to each second one (N, N); and which of those
  // are surely different points (N, N, bool).
  void Add(const torch::Tensor& matching, const torch::Tensor& all, const torch::Tensor& different);

  // Share of the distances between different points below that which 95 % of the matches keep.
  double FalsePositiveRate95() const;
  // Share of the matches that are nearer than any different point of their batch.
  double NearestCorrect() const;
  DistanceQuantiles Quantiles() const;

 private:
  std::vector<float> matching_, nearest_wrong_, different_;
};

}  // namespace lift_slam::training
