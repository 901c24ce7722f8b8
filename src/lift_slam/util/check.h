#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>

namespace lift_slam {

// A bug of the programmer: a broken precondition or invariant. Never thrown for bad input.
class CheckError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void ThrowCheckError(const char* expression, const char* file, int line,
                                  const std::string& message);

}  // namespace lift_slam

// LIFT_SLAM_CHECK(condition, "format {}", values...): throws CheckError when the condition is
// false.
#define LIFT_SLAM_CHECK(condition, ...)                                                         \
  do {                                                                                          \
    if (!(condition)) {                                                                         \
      ::lift_slam::ThrowCheckError(#condition, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)); \
    }                                                                                           \
  } while (false)
