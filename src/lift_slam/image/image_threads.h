#pragma once

namespace lift_slam {

// Keeps OpenCV from running threads of its own beside the program's. Results do not depend on it.
void DisableImageThreads();

}  // namespace lift_slam
