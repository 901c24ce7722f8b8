#pragma once

#include <limits>

namespace lift_slam {

// The nearest and second nearest of the candidates offered, the first one winning a tie.
struct NearestTwo {
  int best = -1, second = -1;
  float best_distance = std::numeric_limits<float>::max();
  float second_distance = std::numeric_limits<float>::max();

  void Offer(int candidate, float distance) {
    if (distance < best_distance) {
      second = best;
      second_distance = best_distance;
      best = candidate;
      best_distance = distance;
    } else if (distance < second_distance) {
      second = candidate;
      second_distance = distance;
    }
  }
  // Lowe's ratio test; true when there was only one candidate.
  bool IsDistinctive(float max_ratio) const {
    return second < 0 || best_distance < max_ratio * second_distance;
  }
};

}  // namespace lift_slam
