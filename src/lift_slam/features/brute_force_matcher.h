#pragma once

#include <limits>
#include <vector>

#include "lift_slam/features/descriptors.h"

namespace lift_slam {

// Every descriptor against every other, without any prediction of where a match may lie.

// The nearest and second nearest candidate of one query. Of equal distances the lower index.
struct DescriptorNeighbours {
  static constexpr float kNone = std::numeric_limits<float>::max();

  int best = -1, second = -1;  // -1: there are not so many candidates
  float best_distance = kNone, second_distance = kNone;

  // Lowe's ratio test; true when there was only one candidate.
  bool IsDistinctive(float max_ratio) const {
    return second < 0 || best_distance < max_ratio * second_distance;
  }
};

// Of each query, in order. CheckError unless both are of one kind.
// L2 distances come as matrix products, |a - b|^2 = |a|^2 + |b|^2 - 2 ab, of descriptors less their
// mean (rounding grows with the norm, and the mean cancels); the two distances of each neighbour
// are then computed by themselves.
std::vector<DescriptorNeighbours> FindNearest(const Descriptors& queries,
                                              const Descriptors& candidates);

struct DescriptorMatch {
  int a = -1, b = -1;     // rows
  float distance = 0.0F;  // in the metric of the descriptors
};

// Rows that are each other's nearest, in order of a. `max_ratio` of best and second-best distance,
// asked of a in b and of b in a; 1 and more: not asked.
std::vector<DescriptorMatch> MatchMutualNearest(const Descriptors& a, const Descriptors& b,
                                                float max_ratio);

}  // namespace lift_slam
