#include "apps/benchmark_entry.h"

#include <fmt/format.h>

#include <algorithm>

namespace lift_slam {
namespace {

std::string Text(const RunStatistics& s, int decimals, CellStatistic statistic) {
  if (statistic == CellStatistic::kRange) {
    return fmt::format("{:.{}f} to {:.{}f}", s.min, decimals, s.max, decimals);
  }
  return fmt::format("{:.{}f}", statistic == CellStatistic::kMean ? s.mean : s.median, decimals);
}

}  // namespace

std::string RunsText(const BenchmarkCell& cell) {
  const int num_ended = static_cast<int>(cell.runs.size());
  if (num_ended == 0) return "?";
  if (num_ended == cell.planned) return fmt::format("{}/{}", cell.NumGood(), cell.planned);
  return fmt::format("{}/{} of {}", cell.NumGood(), num_ended, cell.planned);
}

std::string RunMarks(const BenchmarkCell& cell) {
  const bool has_partial = std::ranges::any_of(
      cell.runs, [](const BenchmarkRun* run) { return run->status == RunStatus::kPartial; });
  std::string marks;
  if (has_partial) marks += fmt::format(" ({:.0f} %)", 100.0 * cell.MeanCoverage());
  if (cell.NumGood() < cell.planned) marks += fmt::format(" {}", RunsText(cell));
  return marks;
}

TableEntry MakeEntry(const BenchmarkCell* cell, bool is_skipped, std::size_t figure,
                     CellStatistic statistic) {
  if (is_skipped) return {"-", {}};
  if (cell == nullptr || cell->runs.empty()) return {"?", {}};
  const RunStatistics s = cell->Statistics(figure);
  const int num_good = cell->NumGood();
  if (num_good == 0) return {cell->HasFailed() ? "X" : "?", {}};
  if (s.num_used == 0) return {"n/a", {}};
  const std::string marks = RunMarks(*cell);
  TableEntry entry{Text(s, kBenchmarkFigures[figure].decimals, statistic) + marks, {}};
  if (statistic != CellStatistic::kRange && marks.empty()) {
    entry.contender = statistic == CellStatistic::kMean ? s.mean : s.median;
  }
  return entry;
}

void MarkBest(ResultTable& table) {
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::optional<double> best;
    for (const BenchmarkTableRow& row : table.ours) {
      const auto& value = row.entries[column].contender;
      if (value && (!best || *value < *best)) best = value;
    }
    for (BenchmarkTableRow& row : table.ours) {
      TableEntry& entry = row.entries[column];
      entry.is_bold = best && entry.contender == best;
    }
  }
}

}  // namespace lift_slam
