#pragma once

#include <filesystem>
#include <optional>

namespace lift_slam {

// The path that an environment variable names; nothing when it is not set or empty.
std::optional<std::filesystem::path> EnvironmentPath(const char* variable);

}  // namespace lift_slam
