#include "lift_slam/image/image_threads.h"

#include <opencv2/core/utility.hpp>
#include <opencv2/core/version.hpp>

namespace lift_slam {

void DisableImageThreads() { cv::setNumThreads(1); }

const char* ImageLibraryVersion() { return "OpenCV " CV_VERSION; }

}  // namespace lift_slam
