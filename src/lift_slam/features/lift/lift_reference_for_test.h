#pragma once

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "lift_slam/util/file.h"

namespace lift_slam {

// The folder with the authors' weights and with expected values, which are not ours to give away:
// LIFT_SLAM_REFERENCE, or lift_reference beside the data. Empty when there is none.
inline std::filesystem::path LiftReferenceFolder() {
  std::filesystem::path folder;
  const char* data = std::getenv("LIFT_SLAM_DATA");
  const char* source = std::getenv("LIFT_SLAM_SOURCE_DIR");
  if (const char* reference = std::getenv("LIFT_SLAM_REFERENCE")) {
    folder = reference;
  } else if (data != nullptr) {
    folder = std::filesystem::path(data) / "../lift_reference";
  } else if (source != nullptr) {
    folder = std::filesystem::path(source) / "../shared/lift_reference";
  }
  return std::filesystem::exists(folder / "tf-lift-release.h5") ? folder : "";
}

template <class Number>
std::vector<Number> ReadRaw(const std::filesystem::path& path) {
  const std::string bytes = ReadText(path);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

}  // namespace lift_slam

#define LIFT_SLAM_SKIP_WITHOUT_REFERENCE()                                              \
  if (LiftReferenceFolder().empty()) {                                                  \
    GTEST_SKIP() << "no reference data (LIFT_SLAM_REFERENCE, or lift_reference beside " \
                    "the data)";                                                        \
  }                                                                                     \
  static_assert(true, "")
