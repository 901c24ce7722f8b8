#pragma once

namespace lift_slam {

// Keeps OpenCV from running threads of its own beside the program's. Results do not depend on it.
void DisableImageThreads();

// "OpenCV 4.6.0": what images are read and resized by, for keys of kept results.
const char* ImageLibraryVersion();

}  // namespace lift_slam
