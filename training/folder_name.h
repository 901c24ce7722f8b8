#pragma once

#include <filesystem>
#include <string>

namespace lift_slam::training {

// The last part of a folder's path, whether or not a slash follows it; of "." that of the folder
// it stands for.
inline std::string FolderName(const std::filesystem::path& folder) {
  return std::filesystem::absolute(folder / ".").lexically_normal().parent_path().filename();
}

}  // namespace lift_slam::training
