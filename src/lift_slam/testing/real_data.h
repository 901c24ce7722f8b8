#pragma once

#include <filesystem>

namespace lift_slam {

// Folder with real sequences for tests: the environment variable LIFT_SLAM_DATA, else
// ../shared/data beside the source tree (LIFT_SLAM_SOURCE_DIR, set by ctest). Empty when there is
// none: tests then skip, GTEST_SKIP() << "no real data: set LIFT_SLAM_DATA".
std::filesystem::path RealDataFolder();

}  // namespace lift_slam
