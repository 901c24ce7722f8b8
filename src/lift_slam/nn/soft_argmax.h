#pragma once

#include <span>

namespace lift_slam::nn {

struct SoftMaximum {
  double x = 0.0, y = 0.0;  // column and row of the map
  double score = 0.0;       // log-mean-exp: max + log(mean(exp(beta (S - max)))) / beta
};

// Centre of mass of exp(beta (S - max S)) over a map of `width` columns (LIFT, eq. 9 and 10).
// CheckError unless the map is a whole number of rows, not empty, and beta > 0.
SoftMaximum SoftArgmax(std::span<const float> map, int width, double beta);

}  // namespace lift_slam::nn
