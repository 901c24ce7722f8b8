#include "lift_slam/slam/slam_options.h"

namespace lift_slam {

BundleOptions SlamOptions::FinalBundleDefaults() {
  BundleOptions options;
  // To the end: what loops leave is smooth along the way, costs little and goes away slowly.
  options.plain_iterations = 50;
  options.function_tolerance = 1e-6;
  return options;
}

}  // namespace lift_slam
