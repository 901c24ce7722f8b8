#pragma once

#include <vector>

namespace lift_slam {

// Matches between two images of one scene turn all keypoints by about the same angle. Collects the
// angle of each match and tells which ones disagree with the three most frequent angles.
class RotationConsistency {
 public:
  // `match` is any number the caller knows the match by.
  void Add(float angle_a_rad, float angle_b_rad, int match);
  // Matches outside the dominant angles, in order of addition.
  std::vector<int> Outliers() const;

 private:
  static constexpr int kBins = 30;
  struct Entry {
    int bin, match;
  };
  std::vector<Entry> entries_;
};

}  // namespace lift_slam
