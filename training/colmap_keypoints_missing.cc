#include <fmt/format.h>

#include "lift_slam/util/input_error.h"
#include "training/colmap_reader.h"

// In place of colmap_keypoints.cc where SQLite is not installed.
namespace lift_slam::training {

std::map<std::uint32_t, std::vector<ColmapKeypoint>> ReadColmapKeypoints(
    const std::filesystem::path& path) {
  throw InputError(fmt::format(
      "{}: this program was built without SQLite and cannot read COLMAP's database; install "
      "libsqlite3-dev and build it again",
      path.string()));
}

}  // namespace lift_slam::training
