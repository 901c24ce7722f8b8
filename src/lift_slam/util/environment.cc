#include "lift_slam/util/environment.h"

#include <cstdlib>

namespace lift_slam {

std::optional<std::filesystem::path> EnvironmentPath(const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr || *value == '\0') return std::nullopt;
  return value;
}

}  // namespace lift_slam
