#include "lift_slam/util/check.h"

namespace lift_slam {

void ThrowCheckError(const char* expression, const char* file, int line,
                     const std::string& message) {
  throw CheckError(fmt::format("{}:{}: check failed: {}: {}", file, line, expression, message));
}

}  // namespace lift_slam
