#include "apps/benchmark_ablation.h"

#include <fmt/format.h>

#include "apps/benchmark_entry.h"

namespace lift_slam {
namespace {

// A row a variant; `make` gives the entry of a cell, which may be null.
template <class Make>
ResultTable MakeTable(const BenchmarkPlan& plan, const BenchmarkCells& cells, std::string title,
                      const Make& make) {
  ResultTable table{std::move(title), ColumnKeys(plan), {}, {}};
  for (const std::string& variant : plan.titles) {
    BenchmarkTableRow row{variant, {}};
    for (const std::string& column : table.columns) {
      const auto cell = cells.find({variant, column});
      row.entries.push_back(make(cell == cells.end() ? nullptr : &cell->second));
    }
    table.ours.push_back(std::move(row));
  }
  return table;
}

TableEntry CoverageEntry(const BenchmarkCell* cell) {
  if (cell == nullptr || cell->runs.empty()) return {"?", {}};
  return {fmt::format("{:.1f}", 100.0 * cell->MeanCoverage()), {}};
}

}  // namespace

std::vector<ResultTable> AblationTables(const BenchmarkPlan& plan, const BenchmarkCells& cells) {
  const auto entry_of = [](std::size_t figure, CellStatistic statistic) {
    return [=](const BenchmarkCell* cell) { return MakeEntry(cell, false, figure, statistic); };
  };
  std::vector<ResultTable> tables;
  const auto add = [&](const char* title, const auto& make) {
    tables.push_back(MakeTable(plan, cells, title, make));
  };
  add("ATE RMSE, median of the runs [m]", entry_of(kAteFigure, CellStatistic::kMedian));
  MarkBest(tables.back());
  add("ATE RMSE, least to largest [m]", entry_of(kAteFigure, CellStatistic::kRange));
  add("Coverage, mean [%]", CoverageEntry);
  add("Time of a frame, median of the runs [ms]",
      entry_of(kFrameTimeFigure, CellStatistic::kMedian));
  return tables;
}

}  // namespace lift_slam
