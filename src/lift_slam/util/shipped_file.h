#pragma once

#include <filesystem>

namespace lift_slam {

// Path of a file or folder that ships with lift_slam: "weights/lift-default.safetensors",
// "vocabularies", "configs/systems" and so on. Looked for in the first of these that is there:
// the folder of the environment variable LIFT_SLAM_SHARE_DIR (taken unseen), ../share/lift_slam
// beside the folder of the running program (an installed one, wherever it was moved), the source
// tree, and the share folder of the prefix that CMake was configured with. The file itself may be
// missing; who opens it says so.
std::filesystem::path ShippedFile(const std::filesystem::path& name);

}  // namespace lift_slam
