#pragma once

#include <chrono>

namespace lift_slam {

// Wall-clock stop watch, started on construction.
class Timer {
 public:
  double ElapsedMs() const {
    return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace lift_slam
