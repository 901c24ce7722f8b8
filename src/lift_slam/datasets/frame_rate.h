#pragma once

namespace lift_slam {

// The rates that options and camera files may give; outside of them nominal times overflow or
// fall together.
inline constexpr double kMinFrameRateHz = 1e-3;
inline constexpr double kMaxFrameRateHz = 1e5;

inline bool IsFrameRate(double rate_hz) {
  return rate_hz >= kMinFrameRateHz && rate_hz <= kMaxFrameRateHz;
}

}  // namespace lift_slam
