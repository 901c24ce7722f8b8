#include "training/training_log.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>

#include "lift_slam/util/file.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam::training {
namespace {

std::vector<std::string> Cells(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

TrainingLog::TrainingLog(const std::filesystem::path& folder, bool going_on, std::int64_t step)
    : folder_(folder) {
  if (!going_on || !std::filesystem::exists(folder / "log.csv")) return;
  for (const std::string& line : ReadLines(folder / "log.csv")) {
    const bool heading = lines_.empty();
    if (heading || (!line.empty() && std::atoll(line.c_str()) <= step)) lines_.push_back(line);
  }
}

// The lines so far, which have other columns than those to come, under a name that is free.
void TrainingLog::PutAside() {
  int number = 1;
  const auto path = [&] { return folder_ / fmt::format("log.{}.csv", number); };
  while (std::filesystem::exists(path())) ++number;
  WriteTextAtomically(path(), Text());
  lines_.clear();
}

std::string TrainingLog::Text() const {
  std::string text;
  for (const std::string& line : lines_) text += line + "\n";
  return text;
}

void TrainingLog::Add(const LogEntry& entry) {
  std::string heading = "step,hours,loss,steps_per_s";
  for (const auto& [name, value] : entry.validation) heading += "," + name;
  if (!lines_.empty() && lines_.front() != heading) PutAside();
  if (lines_.empty()) lines_.push_back(heading);
  std::string line = fmt::format("{},{:.4f},", entry.step, entry.hours);
  line += entry.loss ? fmt::format("{:.5f},{:.2f}", *entry.loss, entry.steps_per_s) : ",";
  for (const auto& [name, value] : entry.validation) line += fmt::format(",{:.5f}", value);
  lines_.push_back(line);
  WriteTextAtomically(folder_ / "log.csv", Text());
  Draw();
}

void TrainingLog::Draw() const {
  const std::vector<std::string> names = Cells(lines_.front());
  std::string page = "<!doctype html><meta charset=\"utf-8\"><title>Training</title><style>" +
                     PlotStyleSheet() + "</style>\n";
  for (std::size_t column = 2; column < names.size(); ++column) {
    PlotSeries series;
    for (std::size_t i = 1; i < lines_.size(); ++i) {
      const std::vector<std::string> cells = Cells(lines_[i]);
      if (cells.size() != names.size() || cells[column].empty()) continue;
      series.x.push_back(std::atof(cells[0].c_str()));
      series.y.push_back(std::atof(cells[column].c_str()));
    }
    Plot plot;
    plot.description = names[column] + " over the steps of the training";
    plot.x.label = "step";
    plot.y.label = names[column];
    plot.series.push_back(series);
    page += RenderSvg(plot) + "\n";
  }
  WriteTextAtomically(folder_ / "curves.html", page);
}

}  // namespace lift_slam::training
