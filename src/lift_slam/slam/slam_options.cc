#include "lift_slam/slam/slam_options.h"

namespace lift_slam {

BundleOptions SlamOptions::FinalBundleDefaults() {
  BundleOptions options;
  return options;
}

}  // namespace lift_slam
