#include "lift_slam/nn/soft_argmax.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/util/check.h"

namespace lift_slam::nn {

SoftMaximum SoftArgmax(std::span<const float> map, int width, double beta) {
  const auto columns = static_cast<std::size_t>(width);
  LIFT_SLAM_CHECK(width > 0 && !map.empty() && map.size() % columns == 0 && beta > 0,
                  "soft argmax of {} values in rows of {}, beta {}", map.size(), width, beta);
  const double maximum = *std::max_element(map.begin(), map.end());
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const double weight = std::exp(beta * (map[i] - maximum));
    sum += weight;
    sum_x += weight * static_cast<double>(i % columns);
    sum_y += weight * static_cast<double>(i / columns);
  }
  const double mean = sum / static_cast<double>(map.size());
  return {sum_x / sum, sum_y / sum, maximum + std::log(mean) / beta};
}

}  // namespace lift_slam::nn
