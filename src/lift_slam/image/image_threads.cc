#include "lift_slam/image/image_threads.h"

#include <opencv2/core/utility.hpp>

namespace lift_slam {

void DisableImageThreads() { cv::setNumThreads(1); }

}  // namespace lift_slam
