#include "lift_slam/util/shipped_file.h"

#include "lift_slam/util/environment.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

fs::path ShareFolder() {
  if (const auto chosen = EnvironmentPath("LIFT_SLAM_SHARE_DIR")) return *chosen;
  if (const auto program = ProgramPath()) {
    const fs::path beside = program->parent_path().parent_path() / "share" / "lift_slam";
    if (IsFolder(beside)) return beside;
  }
  if (IsFolder(fs::path(LIFT_SLAM_SOURCE_TREE) / "weights")) return LIFT_SLAM_SOURCE_TREE;
  return LIFT_SLAM_INSTALLED_SHARE;
}

}  // namespace

fs::path ShippedFile(const fs::path& name) { return ShareFolder() / name; }

}  // namespace lift_slam
