#pragma once

#include <chrono>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>

namespace lift_slam {

inline constexpr int kNoMap = -1;

// How far a run is.
struct Progress {
  std::int64_t frames_done = 0;
  std::optional<std::int64_t> frames_total;  // nothing for a live camera
  std::string state;                         // "tracking"
  int keyframes = 0;                         // kNoMap: neither they nor the points are shown
  int map_points = 0;
  const char* unit = "frames";  // what is counted
};

// Shows a run's progress: on a terminal one line that is drawn over and over, at most ten times a
// second; elsewhere nothing until the end. For one thread.
class ProgressBar {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  enum class Mode { kTerminal, kQuiet };

  // On stderr; quiet unless that is a terminal.
  explicit ProgressBar(TimePoint start = std::chrono::steady_clock::now());
  // On any stream; `columns` is the terminal's width. The stream must outlive the bar.
  ProgressBar(std::ostream& out, Mode mode, int columns, TimePoint start);

  void Update(const Progress& progress, TimePoint now = std::chrono::steady_clock::now());
  // Replaces the bar by one line that sums the run up.
  void Finish(const Progress& progress, TimePoint now = std::chrono::steady_clock::now());

 private:
  std::ostream& out_;
  Mode mode_;
  int columns_;
  TimePoint start_;
  std::optional<TimePoint> drawn_;  // when last
};

}  // namespace lift_slam
