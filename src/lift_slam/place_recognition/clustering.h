#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lift_slam/features/descriptors.h"

namespace lift_slam {

struct ClusteringOptions {
  int num_clusters = 10;
  int max_iterations = 11;
  int num_threads = 1;  // the result does not depend on it
};

struct Clustering {
  Descriptors centers;                   // at most num_clusters, all with rows; of the rows' kind
  std::vector<std::uint8_t> assignment;  // index of its center for each row
};

// k-means of descriptors in memory: greedy k-means++ (Arthur and Vassilvitskii, 2007), then Lloyd's
// iterations until no row changes its cluster or max_iterations. The cost is the squared Euclidean
// distance, which for bits is the Hamming distance; the center of bits is their majority (a tie
// gives 0). Ties between centers go to the first. Fewer clusters than asked for when there are
// fewer different rows. num_clusters <= 255.
Clustering ClusterDescriptors(const Descriptors& rows, const ClusteringOptions& options,
                              std::uint64_t seed);

// Index of the nearest of the centers.
std::uint8_t NearestCenter(const Descriptors& centers, DescriptorView row);

}  // namespace lift_slam
