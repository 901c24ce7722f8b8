#include "lift_slam/image/image_library.h"

#include <opencv2/core/version.hpp>

namespace lift_slam {

const char* ImageLibraryVersion() { return "OpenCV " CV_VERSION; }

}  // namespace lift_slam
