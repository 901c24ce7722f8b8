#pragma once

#include <vector>

#include "lift_slam/features/descriptors.h"
#include "lift_slam/place_recognition/vocabulary.h"

namespace lift_slam {

// Vectors of locally aggregated descriptors (Jegou et al., 2010; normalised as by Arandjelovic and
// Zisserman, 2013) over the nodes of a vocabulary's direct index, about 100: for each node the sum
// of its descriptors' differences from the center, scaled to length 1; then the whole. Bits count
// as -1 and 1. Compared by cosine.
class VladAggregator {
 public:
  explicit VladAggregator(const Vocabulary& vocabulary);

  std::vector<float> Aggregate(const Descriptors& descriptors) const;
  std::size_t dimension() const;

 private:
  const Vocabulary& vocabulary_;
  std::vector<std::vector<float>> centers_;
};

double Cosine(const std::vector<float>& a, const std::vector<float>& b);

}  // namespace lift_slam
