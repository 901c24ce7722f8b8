#include "apps/benchmark_entry.h"

#include <fmt/format.h>

namespace lift_slam {
namespace {

std::string Text(const RunStatistics& s, int decimals, CellStatistic statistic) {
  if (statistic == CellStatistic::kRange) {
    return fmt::format("{:.{}f} to {:.{}f}", s.min, decimals, s.max, decimals);
  }
  return fmt::format("{:.{}f}", statistic == CellStatistic::kMean ? s.mean : s.median, decimals);
}

}  // namespace

TableEntry MakeEntry(const BenchmarkCell* cell, bool is_skipped, std::size_t figure,
                     CellStatistic statistic) {
  if (is_skipped) return {"-", {}};
  if (cell == nullptr || cell->runs.empty()) return {"?", {}};
  const RunStatistics s = cell->Statistics(figure);
  const int num_good = cell->NumGood();
  if (num_good == 0) return {"X", {}};
  if (s.num_used == 0) return {"n/a", {}};
  TableEntry entry{Text(s, kBenchmarkFigures[figure].decimals, statistic), {}};
  if (statistic == CellStatistic::kRange) return entry;
  if (s.num_partial > 0) entry.text += fmt::format(" ({:.0f} %)", 100.0 * cell->MeanCoverage());
  if (num_good < cell->planned) entry.text += fmt::format(" {}/{}", num_good, cell->planned);
  if (s.num_partial == 0 && num_good == cell->planned) {
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
