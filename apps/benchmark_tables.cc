#include "apps/benchmark_tables.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/benchmark_jobs.h"
#include "lift_slam/evaluation/run_statistics.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Figure {
  const char* key;  // in the file of publications and in the CSV
  const char* title;
  const char* pointer;  // in result.json
  double factor;
  int decimals;
};
constexpr std::array<Figure, 3> kFigures = {
    {{"ate_m", "ATE RMSE [m]", "/ate/rmse", 1.0, 3},
     {"t_rel_pct", "t_rel [%]", "/kitti/t_rel_pct", 1.0, 2},
     {"r_rel_deg_per_100m", "r_rel [deg/100 m]", "/kitti/r_rel_deg_per_m", 100.0, 2}}};

struct Cell {
  int planned = 0;
  std::vector<double> coverages;
  std::array<std::vector<RunOutcome>, kFigures.size()> outcomes;
};

// A column: sequence and condition as one key, "03 gamma=2".
std::string ColumnKey(const std::string& sequence, const std::string& condition) {
  return condition == "none" || condition.empty() ? sequence : sequence + " " + condition;
}

using Cells = std::map<std::pair<std::string, std::string>, Cell>;  // by title and column

RunStatus StatusOf(const std::string& name) {
  for (const RunStatus status : {RunStatus::kOk, RunStatus::kPartial, RunStatus::kFailLost}) {
    if (Name(status) == name) return status;
  }
  return RunStatus::kFailInit;
}

void AddResult(const fs::path& path, Cell& cell) {
  const Json json = Json::parse(ReadText(path), nullptr, false);
  if (!json.is_object() || !json.contains("status")) {
    throw InputError(fmt::format("{}: is no result of a run", path.string()));
  }
  const RunStatus status = StatusOf(json["status"].get<std::string>());
  const Json::json_pointer coverage("/coverage/coverage");
  cell.coverages.push_back(json.contains(coverage) ? json.at(coverage).get<double>() : 0.0);
  for (std::size_t i = 0; i < kFigures.size(); ++i) {
    const Json::json_pointer pointer(kFigures[i].pointer);
    RunOutcome outcome{status, std::nullopt};
    if (json.contains(pointer) && json.at(pointer).is_number()) {
      outcome.value = kFigures[i].factor * json.at(pointer).get<double>();
    }
    cell.outcomes[i].push_back(outcome);
  }
}

Cells ReadCells(const BenchmarkPlan& plan, const fs::path& folder) {
  Cells cells;
  for (const BenchmarkJob& job : plan.jobs) {
    Cell& cell = cells[{job.title, ColumnKey(job.sequence, job.distortion)}];
    ++cell.planned;
    if (IsFinished(folder, job)) AddResult(ResultFolder(folder, job) / "result.json", cell);
  }
  return cells;
}

double MeanCoverage(const Cell& cell) {
  double sum = 0.0;
  for (const double coverage : cell.coverages) sum += coverage;
  return cell.coverages.empty() ? 0.0 : sum / static_cast<double>(cell.coverages.size());
}

// What stands in a table, and whether it may win.
struct Entry {
  std::string text;
  std::optional<double> contender;
  bool is_bold = false;
};

Entry MakeEntry(const Cell* cell, bool is_skipped, std::size_t figure) {
  if (is_skipped) return {"-", {}};
  if (cell == nullptr || cell->coverages.empty()) return {"?", {}};
  const RunStatistics s = SummarizeRuns(cell->outcomes[figure]);
  const auto num_good = std::ranges::count_if(
      cell->outcomes[figure], [](const RunOutcome& run) { return !IsFailure(run.status); });
  if (num_good == 0) return {"X", {}};
  if (s.num_used == 0) return {"n/a", {}};
  Entry entry{fmt::format("{:.{}f}", s.mean, kFigures[figure].decimals), {}};
  if (s.num_partial > 0) entry.text += fmt::format(" ({:.0f} %)", 100.0 * MeanCoverage(*cell));
  if (num_good < cell->planned) entry.text += fmt::format(" {}/{}", num_good, cell->planned);
  if (s.num_partial == 0 && num_good == cell->planned) entry.contender = s.mean;
  return entry;
}

struct Row {
  std::string title;
  std::vector<Entry> entries;
};

struct Table {
  std::string title;
  std::vector<std::string> columns;
  std::vector<Row> ours, others;
};

void MarkBest(Table& table) {
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    std::optional<double> best;
    for (const Row& row : table.ours) {
      const auto& value = row.entries[column].contender;
      if (value && (!best || *value < *best)) best = value;
    }
    for (Row& row : table.ours) {
      Entry& entry = row.entries[column];
      entry.is_bold = best && entry.contender == best;
    }
  }
}

std::vector<Row> OtherRows(const fs::path& path, const std::string& suite, const char* figure,
                           const std::vector<std::string>& columns) {
  if (path.empty()) return {};
  std::vector<Row> rows;
  try {
    for (const YAML::Node& system : YAML::LoadFile(path.string())[suite]) {
      if (!system[figure]) continue;
      Row row{system["name"].as<std::string>() + " [" + system["source"].as<std::string>() + "]",
              {}};
      for (const std::string& column : columns) {
        const YAML::Node value = system[figure][column];
        row.entries.push_back({value ? value.as<std::string>() : "", {}});
      }
      rows.push_back(row);
    }
  } catch (const YAML::Exception& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
  return rows;
}

std::vector<Table> MakeTables(const BenchmarkPlan& plan, const Cells& cells,
                              const fs::path& publications) {
  std::vector<Table> tables;
  for (std::size_t figure = 0; figure < kFigures.size(); ++figure) {
    Table table{kFigures[figure].title, {}, {}, {}};
    for (const std::string& title : plan.titles) {
      Row row{title, {}};
      table.columns.clear();
      for (const std::string& sequence : plan.sequences) {
        for (const std::string& condition : plan.conditions) {
          const std::string column = ColumnKey(sequence, condition);
          const auto cell = cells.find({title, column});
          const bool is_skipped =
              std::ranges::find(plan.skipped, title + "|" + sequence) != plan.skipped.end();
          table.columns.push_back(column);
          row.entries.push_back(
              MakeEntry(cell == cells.end() ? nullptr : &cell->second, is_skipped, figure));
        }
      }
      table.ours.push_back(row);
    }
    MarkBest(table);
    table.others = OtherRows(publications, plan.suite, kFigures[figure].key, table.columns);
    tables.push_back(table);
  }
  return tables;
}

// How a format writes a table; the rest is the same for all.
struct Format {
  std::string begin_table, end_table, begin_row, between, end_row, begin_bold, end_bold;
  std::string (*escape)(const std::string&);
};

std::string Replace(const std::string& text, const std::map<char, std::string>& replacements) {
  std::string result;
  for (const char c : text) {
    const auto found = replacements.find(c);
    result += found == replacements.end() ? std::string(1, c) : found->second;
  }
  return result;
}

std::string EscapeMarkdown(const std::string& text) { return Replace(text, {{'|', "\\|"}}); }
std::string EscapeLatex(const std::string& text) {
  return Replace(text, {{'%', "\\%"}, {'_', "\\_"}, {'&', "\\&"}, {'#', "\\#"}});
}
std::string EscapeHtml(const std::string& text) {
  return Replace(text, {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}});
}

std::string RowText(const Format& format, const std::string& title,
                    const std::vector<Entry>& entries) {
  std::string text = format.begin_row + format.escape(title);
  for (const Entry& entry : entries) {
    const std::string cell = format.escape(entry.text);
    text += format.between + (entry.is_bold ? format.begin_bold + cell + format.end_bold : cell);
  }
  return text + format.end_row;
}

// With `rule` after the header.
std::string TableText(const Format& format, const Table& table, const std::string& rule) {
  std::vector<Entry> header;
  for (const std::string& column : table.columns) header.push_back({column, {}});
  std::string text = format.begin_table + RowText(format, table.title, header) + rule;
  for (const auto* rows : {&table.ours, &table.others}) {
    for (const Row& row : *rows) text += RowText(format, row.title, row.entries);
  }
  return text + format.end_table;
}

std::string Footer(const BenchmarkPlan& plan) {
  std::string text = fmt::format(
      "Means over the runs, revision {}. X: every run failed. -: left out, the system was trained "
      "with the sequence (ours) or not given (others). ?: not run. (p %): mean coverage where a "
      "run kept 50 to 90 % of the frames. k/n: runs that succeeded. Bold: best of ours where all "
      "runs succeeded. r_rel of the LIFT-SLAM paper is taken as deg/100 m.",
      plan.revision);
  for (const std::string& sentence : plan.missing) text += "\nMissing: " + sentence + ".";
  return text;
}

std::string Csv(const BenchmarkPlan& plan, const Cells& cells) {
  std::string text =
      "suite,system,sequence,figure,runs,runs_ok_or_partial,runs_partial,coverage_mean_pct,mean,"
      "median,min,max\n";
  for (const auto& [key, cell] : cells) {
    for (std::size_t i = 0; i < kFigures.size(); ++i) {
      const RunStatistics s = SummarizeRuns(cell.outcomes[i]);
      text += fmt::format("{},\"{}\",\"{}\",{},{},{},{},{:.2f},", plan.suite, key.first, key.second,
                          kFigures[i].key, s.num_runs, s.num_used, s.num_partial,
                          100.0 * MeanCoverage(cell));
      text += s.num_used == 0
                  ? ",,,\n"
                  : fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}\n", s.mean, s.median, s.min, s.max);
    }
  }
  return text;
}

Table StatisticsTable(const Cells& cells) {
  Table table{
      "System, sequence", {"runs", "coverage [%]", "ATE mean [m]", "median", "min", "max"}, {}, {}};
  for (const auto& [key, cell] : cells) {
    const RunStatistics s = SummarizeRuns(cell.outcomes[0]);
    Row row{key.first + ", " + key.second, {}};
    row.entries.push_back({fmt::format("{}/{}", s.num_used, cell.planned), {}});
    row.entries.push_back({fmt::format("{:.1f}", 100.0 * MeanCoverage(cell)), {}});
    for (const double value : {s.mean, s.median, s.min, s.max}) {
      row.entries.push_back({s.num_used == 0 ? "n/a" : fmt::format("{:.4f}", value), {}});
    }
    table.ours.push_back(row);
  }
  return table;
}

}  // namespace

BenchmarkTables MakeBenchmarkTables(const BenchmarkPlan& plan, const fs::path& folder,
                                    const fs::path& publications) {
  const Cells cells = ReadCells(plan, folder);
  std::vector<Table> tables = MakeTables(plan, cells, publications);
  tables.push_back(StatisticsTable(cells));
  BenchmarkTables texts;
  texts.csv = Csv(plan, cells);
  const Format markdown{"", "\n", "| ", " | ", " |\n", "**", "**", EscapeMarkdown};
  const Format html{"<table>\n",    "</table>\n", "<tr><td>", "</td><td>",
                    "</td></tr>\n", "<b>",        "</b>",     EscapeHtml};
  texts.html =
      "<!DOCTYPE html><html lang=\"en\"><meta charset=\"utf-8\"><title>Benchmark</title><style>"
      "body{font:15px sans-serif;margin:2em}table{border-collapse:collapse;margin:1.5em 0}td{"
      "border-bottom:1px solid #ddd;padding:.3em .7em;text-align:right;white-space:nowrap}"
      "td:first-child{text-align:left}tr:first-child{background:#f0f2f5;font-weight:600}p{"
      "max-width:60em}</style>\n";
  texts.html += fmt::format("<h1>Benchmark: {}</h1>\n", EscapeHtml(plan.suite));
  for (const Table& table : tables) {
    std::string rule = "| ---";
    for (std::size_t i = 0; i < table.columns.size(); ++i) rule += " | ---:";
    texts.markdown += TableText(markdown, table, rule + " |\n");
    const Format latex{
        fmt::format("\\begin{{tabular}}{{l{}}}\n\\hline\n", std::string(table.columns.size(), 'r')),
        "\\hline\n\\end{tabular}\n\n",
        "",
        " & ",
        " \\\\\n",
        "\\textbf{",
        "}",
        EscapeLatex};
    texts.latex += TableText(latex, table, "\\hline\n");
    texts.html += TableText(html, table, "");
  }
  const std::string footer = Footer(plan);
  texts.markdown += footer + "\n";
  texts.latex += "% " + Replace(footer, {{'\n', "\n% "}}) + "\n";
  texts.html += "<p>" + Replace(EscapeHtml(footer), {{'\n', "<br>"}}) + "</p></html>\n";
  return texts;
}

}  // namespace lift_slam
