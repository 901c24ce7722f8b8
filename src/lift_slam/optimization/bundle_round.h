#pragma once

#include <string>

namespace lift_slam {

// One round of a bundle adjustment, as SolveBundle asks it of its solvers.
struct BundleRoundOptions {
  int max_iterations = 0;
  double huber_width = 0.0;         // of the robust loss, in standard deviations; infinity: none
  double function_tolerance = 0.0;  // relative change of the cost that ends the round
  int num_threads = 1;
  double max_time_s = 0.0;  // infinity: no limit
};

struct BundleRoundSummary {
  double initial_cost = 0.0;  // 1/2 sum of losses
  double final_cost = 0.0;
  int iterations = 0;  // failed steps included
  bool usable = false;
  std::string message;  // why it ended
};

}  // namespace lift_slam
