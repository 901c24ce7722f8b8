#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/features/descriptors.h"

namespace lift_slam {

// Sums of the descriptors of each cluster, for its center: float sums in double, counts of set bits
// for bits.
class ClusterSums {
 public:
  ClusterSums(DescriptorKind kind, std::size_t num_clusters);

  void Add(std::size_t cluster, DescriptorView row);
  void Add(const ClusterSums& other);
  // The mean, or the majority of the bits (a tie gives 0); leaves the center of an empty cluster.
  void WriteCenter(std::size_t cluster, Descriptors& centers) const;

 private:
  void AddBits(std::int32_t* sums, DescriptorView row);

  DescriptorKind kind_;
  std::size_t dimension_;
  std::vector<std::size_t> counts_;
  std::vector<double> floats_;      // of kL2, cluster by cluster
  std::vector<std::int32_t> bits_;  // of kHamming
};

}  // namespace lift_slam
