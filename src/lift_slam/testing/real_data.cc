#include "lift_slam/testing/real_data.h"

#include <cstdlib>

namespace lift_slam {

std::filesystem::path RealDataFolder() {
  std::filesystem::path folder;
  if (const char* data = std::getenv("LIFT_SLAM_DATA")) {
    folder = data;
  } else if (const char* source = std::getenv("LIFT_SLAM_SOURCE_DIR")) {
    folder = std::filesystem::path(source).parent_path() / "shared" / "data";
  }
  return std::filesystem::is_directory(folder) ? folder : std::filesystem::path();
}

}  // namespace lift_slam
