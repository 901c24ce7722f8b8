#include "apps/benchmark_tables.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "apps/benchmark_ablation.h"
#include "apps/benchmark_entry.h"
#include "apps/benchmark_page.h"
#include "apps/benchmark_table_text.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// Those that have a number of one of the columns at least.
std::vector<BenchmarkTableRow> OtherRows(const std::filesystem::path& path,
                                         const std::string& suite, const char* figure,
                                         const std::vector<std::string>& columns) {
  if (path.empty()) return {};
  std::vector<BenchmarkTableRow> rows;
  try {
    for (const YAML::Node& system : YAML::LoadFile(path.string())[suite]) {
      if (!system[figure]) continue;
      BenchmarkTableRow row{
          system["name"].as<std::string>(), {}, system["source"].as<std::string>()};
      for (const std::string& column : columns) {
        const YAML::Node value = system[figure][column];
        row.entries.push_back({value ? value.as<std::string>() : "-", {}});
      }
      const bool has_number = std::ranges::any_of(
          row.entries, [](const TableEntry& entry) { return entry.text != "-"; });
      if (has_number) rows.push_back(row);
    }
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
  return rows;
}

bool IsSkipped(const BenchmarkPlan& plan, const std::string& title, const std::string& sequence) {
  return std::ranges::find(plan.skipped, title + "|" + sequence) != plan.skipped.end();
}

ResultTable MakeTable(const BenchmarkPlan& plan, const BenchmarkCells& cells, std::size_t figure) {
  ResultTable table{kBenchmarkFigures[figure].title, ColumnKeys(plan), {}, {}};
  for (const std::string& title : plan.titles) {
    BenchmarkTableRow row{title, {}};
    for (const std::string& sequence : plan.sequences) {
      for (const std::string& condition : plan.conditions) {
        const auto cell = cells.find({title, ColumnKey(sequence, condition)});
        row.entries.push_back(MakeEntry(cell == cells.end() ? nullptr : &cell->second,
                                        IsSkipped(plan, title, sequence), figure,
                                        CellStatistic::kMean));
      }
    }
    table.ours.push_back(row);
  }
  MarkBest(table);
  return table;
}

// Whether a run of ours has the figure: indoor data has none of KITTI's.
bool HasNumber(const std::vector<BenchmarkRun>& runs, std::size_t figure) {
  return std::ranges::any_of(
      runs, [&](const BenchmarkRun& run) { return run.figures[figure].has_value(); });
}

// As ColumnKey, with a star at sequences of which only a part was run.
std::vector<std::string> ColumnTitles(const BenchmarkPlan& plan,
                                      const std::vector<BenchmarkRun>& runs) {
  const auto excerpts = FindExcerpts(plan, runs);
  std::vector<std::string> titles;
  for (const std::string& sequence : plan.sequences) {
    const bool is_excerpt =
        std::ranges::find(excerpts, sequence, &BenchmarkExcerpt::sequence) != excerpts.end();
    for (const std::string& condition : plan.conditions) {
      titles.push_back(ColumnKey(is_excerpt ? sequence + "*" : sequence, condition));
    }
  }
  return titles;
}

std::vector<ResultTable> MakeTables(const BenchmarkPlan& plan,
                                    const std::vector<BenchmarkRun>& runs,
                                    const BenchmarkCells& cells,
                                    const std::filesystem::path& publications) {
  if (plan.suite == "ablation") return AblationTables(plan, cells);
  std::vector<ResultTable> tables;
  for (std::size_t figure = 0; figure < kNumErrorFigures; ++figure) {
    ResultTable table = MakeTable(plan, cells, figure);
    table.others =
        OtherRows(publications, plan.suite, kBenchmarkFigures[figure].key, table.columns);
    if (figure > 0 && table.others.empty() && !HasNumber(runs, figure)) continue;
    table.columns = ColumnTitles(plan, runs);
    tables.push_back(plan.conditions.size() > 1 ? Transposed(table) : table);
  }
  return tables;
}

// Every row of the statistics, in the order of the tables.
template <class Function>
void ForEachCell(const BenchmarkPlan& plan, const BenchmarkCells& cells, const Function& function) {
  for (const std::string& sequence : plan.sequences) {
    for (const std::string& condition : plan.conditions) {
      for (const std::string& title : plan.titles) {
        const std::string column = ColumnKey(sequence, condition);
        const auto cell = cells.find({title, column});
        if (cell != cells.end()) function(title, column, cell->second);
      }
    }
  }
}

std::string Csv(const BenchmarkPlan& plan, const BenchmarkCells& cells) {
  std::string text =
      "suite,system,sequence,figure,runs,runs_ok_or_partial,runs_partial,coverage_mean_pct,mean,"
      "median,min,max\n";
  ForEachCell(plan, cells, [&](const auto& title, const auto& column, const BenchmarkCell& cell) {
    for (std::size_t i = 0; i < kBenchmarkFigures.size(); ++i) {
      const RunStatistics s = cell.Statistics(i);
      text += fmt::format("{},\"{}\",\"{}\",{},{},{},{},{:.2f},", plan.suite, title, column,
                          kBenchmarkFigures[i].key, s.num_runs, s.num_used, s.num_partial,
                          100.0 * cell.MeanCoverage());
      text += s.num_used == 0
                  ? ",,,\n"
                  : fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", s.mean, s.median, s.min, s.max);
    }
  });
  return text;
}

ResultTable StatisticsTable(const BenchmarkPlan& plan, const BenchmarkCells& cells) {
  ResultTable table{
      "Sequence, system", {"runs", "coverage [%]", "ATE mean [m]", "median", "min", "max"}, {}, {}};
  ForEachCell(plan, cells, [&](const auto& title, const auto& column, const BenchmarkCell& cell) {
    const RunStatistics s = cell.Statistics(0);
    const std::string none = s.num_runs == 0 ? "?" : "n/a";
    BenchmarkTableRow row{column + ", " + title, {}};
    row.entries.push_back({RunsText(cell), {}});
    row.entries.push_back(
        {s.num_runs == 0 ? none : fmt::format("{:.1f}", 100.0 * cell.MeanCoverage()), {}});
    for (const double value : {s.mean, s.median, s.min, s.max}) {
      row.entries.push_back({s.num_used == 0 ? none : fmt::format("{:.4f}", value), {}});
    }
    table.ours.push_back(row);
  });
  return table;
}

std::vector<std::string> Remarks(const BenchmarkPlan& plan, const std::vector<BenchmarkRun>& runs) {
  std::vector<std::string> remarks = {fmt::format(
      "{}evision {}. X: every run failed. -: left out, the system was trained "
      "with the sequence (ours) or not given (others). ?: not run, or no run has succeeded yet and "
      "some are still to be run. n/a: not measured (no ground truth, or no stretch of 100 m). "
      "(p %): mean coverage where a run kept 50 to 90 % of the frames. k/n: k of n runs succeeded; "
      "k/n of m: m are planned, n have ended. Bold: best of ours, and of trajectories given, where "
      "all runs succeeded with at least 90 % of the frames. r_rel of the LIFT-SLAM paper is taken "
      "as deg/100 m.",
      plan.suite == "ablation" ? "R" : "Means over the runs, r", plan.revision)};
  if (!plan.frames.empty()) {
    remarks.push_back(fmt::format("Only frames {} of each sequence were run.", plan.frames));
  }
  for (const BenchmarkExcerpt& excerpt : FindExcerpts(plan, runs)) {
    remarks.push_back(fmt::format(
        "*: of {} only {} of {} frames were run; the numbers that others published are of all.",
        excerpt.sequence, excerpt.frames, excerpt.published_frames));
  }
  if (plan.suite == "ablation") {
    remarks.push_back(
        "Time of a frame: extraction and tracking, without mapping; comparable where one run at a "
        "time had the machine for itself.");
  }
  for (const std::string& title : plan.titles) {
    const auto run = std::ranges::find_if(
        runs, [&](const BenchmarkRun& r) { return r.title == title && !r.notice.empty(); });
    if (run != runs.end()) remarks.push_back(title + ": " + run->notice + ".");
  }
  for (const std::string& sentence : plan.missing) remarks.push_back("Missing: " + sentence + ".");
  return remarks;
}

// Tables 1 and 3 of the paper have one figure, its Tables 2, 4 and 5 several.
std::string Latex(const BenchmarkPlan& plan, const std::vector<ResultTable>& tables) {
  if (tables.size() == 1) return LatexTable(tables.front());
  if (plan.suite == "ablation") {
    std::string text;
    for (const ResultTable& table : tables) text += LatexTable(table);
    return text;
  }
  return plan.conditions.size() > 1 ? LatexTableByColumn(tables) : LatexTableByRow(tables);
}

}  // namespace

BenchmarkTables CompleteTexts(BenchmarkTables texts, const BenchmarkPlan& plan,
                              const std::vector<ResultTable>& tables, const ResultTable& statistics,
                              const std::vector<std::string>& remarks,
                              const std::vector<BenchmarkPicture>& pictures) {
  for (const ResultTable& table : tables) texts.markdown += MarkdownTable(table);
  texts.markdown += MarkdownTable(statistics);
  texts.latex += LatexTable(statistics);
  for (const std::string& remark : remarks) {
    texts.markdown += remark + "\n\n";
    texts.latex += "% " + remark + "\n";
  }
  texts.html = BenchmarkPage(plan, tables, statistics, pictures, remarks);
  return texts;
}

BenchmarkTables MakeBenchmarkTables(const BenchmarkPlan& plan,
                                    const std::vector<BenchmarkRun>& runs,
                                    const std::filesystem::path& publications,
                                    const std::vector<BenchmarkPicture>& pictures) {
  const BenchmarkCells cells = SortIntoCells(plan, runs);
  const std::vector<ResultTable> tables = MakeTables(plan, runs, cells, publications);
  const ResultTable statistics = StatisticsTable(plan, cells);
  const std::vector<std::string> remarks = Remarks(plan, runs);
  return CompleteTexts({.csv = Csv(plan, cells), .latex = Latex(plan, tables)}, plan, tables,
                       statistics, remarks, pictures);
}

}  // namespace lift_slam
