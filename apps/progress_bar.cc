#include "apps/progress_bar.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>

namespace lift_slam {
namespace {

constexpr std::chrono::milliseconds kLeastInterval(100);
constexpr int kBarCells = 20;
constexpr int kDefaultColumns = 80;
constexpr const char* kClearToEnd = "\x1b[K";

int TerminalColumns(int descriptor) {
  winsize size{};
  if (ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kDefaultColumns;
  return size.ws_col;
}

double Seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

double FramesPerSecond(const Progress& progress, double elapsed_s) {
  return elapsed_s > 0.0 ? static_cast<double>(progress.frames_done) / elapsed_s : 0.0;
}

// "1:05" or "2:00:10".
std::string Clock(double seconds) {
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  const std::int64_t hours = whole / 3600, minutes = whole / 60 % 60;
  if (hours > 0) return fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60);
  return fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string MapText(const Progress& progress) {
  if (progress.keyframes == kNoMap) return progress.state;
  return fmt::format("{}, {} keyframes, {} points", progress.state, progress.keyframes,
                     progress.map_points);
}

// "[#####---------------] 40/160 frames, 20.0/s, 0:06 left, tracking, 5 keyframes, 812 points"
std::string BarLine(const Progress& progress, double elapsed_s) {
  const double rate = FramesPerSecond(progress, elapsed_s);
  if (!progress.frames_total) {
    return fmt::format("{} {}, {:.1f}/s, {}", progress.frames_done, progress.unit, rate,
                       MapText(progress));
  }
  const std::int64_t total = std::max<std::int64_t>(*progress.frames_total, 1);
  const std::int64_t done = std::clamp<std::int64_t>(progress.frames_done, 0, total);
  const auto filled = static_cast<std::size_t>(kBarCells * done / total);
  const std::string left =
      rate > 0.0 ? Clock(static_cast<double>(total - done) / rate) : std::string("?");
  return fmt::format("[{}{}] {}/{} {}, {:.1f}/s, {} left, {}", std::string(filled, '#'),
                     std::string(kBarCells - filled, '-'), progress.frames_done,
                     *progress.frames_total, progress.unit, rate, left, MapText(progress));
}

std::string SummaryLine(const Progress& progress, double elapsed_s) {
  std::string frames = std::to_string(progress.frames_done);
  if (progress.frames_total) frames += fmt::format("/{}", *progress.frames_total);
  return fmt::format("{} {} in {:.1f} s ({:.1f} {}/s), {}", frames, progress.unit, elapsed_s,
                     FramesPerSecond(progress, elapsed_s), progress.unit, MapText(progress));
}

}  // namespace

ProgressBar::ProgressBar(TimePoint start)
    : ProgressBar(std::cerr, isatty(STDERR_FILENO) != 0 ? Mode::kTerminal : Mode::kQuiet,
                  TerminalColumns(STDERR_FILENO), start) {}

ProgressBar::ProgressBar(std::ostream& out, Mode mode, int columns, TimePoint start)
    : out_(out), mode_(mode), columns_(columns), start_(start) {}

void ProgressBar::Update(const Progress& progress, TimePoint now) {
  if (mode_ == Mode::kQuiet || (drawn_ && now - *drawn_ < kLeastInterval)) return;
  drawn_ = now;
  // One column stays free: a full line would wrap.
  std::string line = BarLine(progress, Seconds(now - start_));
  line.resize(std::min(line.size(), static_cast<std::size_t>(std::max(columns_ - 1, 0))));
  out_ << '\r' << line << kClearToEnd << std::flush;
}

void ProgressBar::Finish(const Progress& progress, TimePoint now) {
  if (mode_ == Mode::kTerminal) out_ << '\r' << kClearToEnd;
  out_ << SummaryLine(progress, Seconds(now - start_)) << '\n' << std::flush;
}

}  // namespace lift_slam
