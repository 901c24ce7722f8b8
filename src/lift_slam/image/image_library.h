#pragma once

namespace lift_slam {

// "OpenCV 4.6.0": what images are read and resized by, for keys of kept results.
const char* ImageLibraryVersion();

}  // namespace lift_slam
