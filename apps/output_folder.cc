#include "apps/output_folder.h"

#include <fmt/format.h>

#include <system_error>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

void PrepareOutputFolder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (std::filesystem::exists(folder) && !std::filesystem::is_directory(folder)) {
    throw InputError(fmt::format("{}: is a file, expected an output folder", folder.string()));
  }
  if (error) {
    throw InputError(
        fmt::format("{}: cannot create the output folder: {}", folder.string(), error.message()));
  }
  const std::filesystem::path probe = folder / ".lift_slam_write_test";
  try {
    WriteTextAtomically(probe, "lift_slam\n");
  } catch (const InputError&) {
    throw InputError(
        fmt::format("{}: the output folder is not writable (no permission, read-only "
                    "or disk full)",
                    folder.string()));
  }
  std::filesystem::remove(probe, error);
  std::filesystem::remove(folder / "result.json", error);
}

}  // namespace lift_slam
