#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lift_slam::training {

// One line of log.csv.
struct LogEntry {
  std::int64_t step = 0;
  double hours = 0.0;            // spent training
  std::optional<double> loss{};  // mean since the line before; nothing: no step was made
  double steps_per_s = 0.0;
  std::vector<std::pair<std::string, double>> validation{};  // empty: without validation sets
};

// The course of a run: log.csv and, drawn from it, curves.html (SVG). Where a run goes on with
// other figures of its validation a new log.csv begins, and what was there becomes log.1.csv,
// log.2.csv...
class TrainingLog {
 public:
  // `folder` is the run's. With `going_on`, lines up to `step` are kept and later ones, of a run
  // that ended before its checkpoint, dropped.
  TrainingLog(const std::filesystem::path& folder, bool going_on, std::int64_t step);
  // Throws InputError when the files cannot be written.
  void Add(const LogEntry& entry);

 private:
  void PutAside();
  std::string Text() const;
  void Draw() const;

  std::filesystem::path folder_;
  std::vector<std::string> lines_;  // the heading first
};

}  // namespace lift_slam::training
