#include "lift_slam/evaluation/run_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <tuple>

#include "lift_slam/evaluation/run_statistics.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Json = nlohmann::json;

struct Run {
  RunStatus status = RunStatus::kFailInit;
  bool skipped = false;
  double coverage = 0.0;
  std::optional<double> ate_rmse_m, t_rel_pct, r_rel_deg_per_m;
  int segments = 0;
};

// What one row of the tables stands for, in the order of the rows.
struct RowKey {
  std::string dataset, sequence, configuration, distortion, trajectory, gt_frame, alignment;
  std::string settings_sha256;  // empty: not known

  auto Shown() const {
    return std::tie(dataset, sequence, configuration, distortion, trajectory, gt_frame, alignment);
  }
  bool operator<(const RowKey& other) const {
    return std::tuple_cat(Shown(), std::tie(settings_sha256)) <
           std::tuple_cat(other.Shown(), std::tie(other.settings_sha256));
  }
};

struct Runs {
  std::map<RowKey, std::vector<Run>> rows;
  std::set<std::string> settings;  // lines of the footer
};

// Reads fields of one result.json; errors name the file and the field.
class ResultReader {
 public:
  explicit ResultReader(const std::filesystem::path& path) : path_(path) {
    json_ = Json::parse(ReadText(path), nullptr, /*allow_exceptions=*/false);
    if (!json_.is_object()) throw InputError(fmt::format("{}: no JSON object", path.string()));
  }

  // The value at a path such as "/ate/rmse"; null when absent or below a null.
  Json Find(const std::string& pointer) const {
    const Json::json_pointer p(pointer);
    return json_.contains(p) ? json_.at(p) : Json();
  }
  std::string Text(const std::string& pointer) const {
    const Json value = Find(pointer);
    if (!value.is_string()) Fail(pointer, "a string");
    return value.get<std::string>();
  }
  std::string TextOrEmpty(const std::string& pointer) const {
    return Find(pointer).is_null() ? std::string() : Text(pointer);
  }
  double Number(const std::string& pointer) const {
    const Json value = Find(pointer);
    if (!value.is_number()) Fail(pointer, "a number");
    return value.get<double>();
  }
  std::optional<double> NumberOrNull(const std::string& pointer) const {
    if (Find(pointer).is_null()) return std::nullopt;
    return Number(pointer);
  }

 private:
  [[noreturn]] void Fail(const std::string& pointer, std::string_view expected) const {
    throw InputError(
        fmt::format("{}: field {} is missing or not {}", path_.string(), pointer, expected));
  }

  std::filesystem::path path_;
  Json json_;
};

Run ReadRun(const ResultReader& reader, const std::filesystem::path& path) {
  constexpr RunStatus kStatuses[] = {RunStatus::kOk, RunStatus::kPartial, RunStatus::kFailInit,
                                     RunStatus::kFailLost};
  Run run;
  const std::string status = reader.Text("/status");
  run.skipped = status == "SKIPPED";
  if (run.skipped) return run;
  const auto found = std::find_if(std::begin(kStatuses), std::end(kStatuses),
                                  [&](RunStatus s) { return Name(s) == status; });
  if (found == std::end(kStatuses)) {
    throw InputError(
        fmt::format("{}: field /status is '{}', expected OK, PARTIAL, FAIL_INIT, "
                    "FAIL_LOST or SKIPPED",
                    path.string(), status));
  }
  run.status = *found;
  run.coverage = reader.Number("/coverage/coverage");
  run.ate_rmse_m = reader.NumberOrNull("/ate/rmse");
  run.t_rel_pct = reader.NumberOrNull("/kitti/t_rel_pct");
  run.r_rel_deg_per_m = reader.NumberOrNull("/kitti/r_rel_deg_per_m");
  run.segments = static_cast<int>(reader.NumberOrNull("/kitti/segments").value_or(0.0));
  return run;
}

std::string PairingText(const ResultReader& reader) {
  const std::string method = reader.Text("/association/method");
  if (method != "time") return "pairs by " + method;
  return fmt::format("pairs by time (at most {} ms apart)",
                     reader.Number("/association/max_time_difference_ms"));
}

std::string SettingsLine(const ResultReader& reader) {
  return fmt::format(
      "Alignment {}, reference positions of the {}, {}. OK: coverage at least {:.0f} %; partial: "
      "at least {:.0f} %; lost for more than {} s at the end is a failure.",
      reader.Text("/alignment/mode"), reader.Text("/gt_frame") == "cam" ? "camera" : "body (IMU)",
      PairingText(reader), 100.0 * reader.Number("/thresholds/min_ok_coverage"),
      100.0 * reader.Number("/thresholds/min_partial_coverage"),
      reader.Number("/thresholds/max_lost_at_end_s"));
}

Runs ReadRuns(const std::vector<std::filesystem::path>& files) {
  Runs runs;
  for (const std::filesystem::path& file : files) {
    const ResultReader reader(file);
    RowKey key{
        reader.TextOrEmpty("/dataset"),        reader.TextOrEmpty("/sequence"),
        reader.TextOrEmpty("/configuration"),  reader.TextOrEmpty("/provenance/distortion"),
        reader.TextOrEmpty("/mode"),           reader.TextOrEmpty("/gt_frame"),
        reader.TextOrEmpty("/alignment/mode"), reader.TextOrEmpty("/provenance/settings_sha256")};
    const Run run = ReadRun(reader, file);
    if (!run.skipped) runs.settings.insert(SettingsLine(reader));
    runs.rows[std::move(key)].push_back(run);
  }
  return runs;
}

// With the distortion and, where rows differ in settings alone, the first digits of their SHA-256.
std::string ConfigurationText(const Runs& runs, const RowKey& key) {
  std::vector<std::string> parts;
  if (!key.configuration.empty()) parts.push_back(key.configuration);
  if (!key.distortion.empty()) parts.push_back(key.distortion);
  const auto num_alike = std::count_if(runs.rows.begin(), runs.rows.end(), [&](const auto& row) {
    return row.first.Shown() == key.Shown();
  });
  if (num_alike > 1) {
    parts.push_back("settings " +
                    (key.settings_sha256.empty() ? "unknown" : key.settings_sha256.substr(0, 8)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

// The statistics of one figure over the runs of a row.
RunStatistics Statistics(const std::vector<Run>& runs, std::optional<double> Run::*figure) {
  std::vector<RunOutcome> outcomes;
  for (const Run& run : runs) outcomes.push_back({run.status, run.*figure});
  return SummarizeRuns(outcomes);
}

struct RowSummary {
  bool skipped = false;
  int num_runs = 0, num_good = 0, num_partial = 0;  // good: OK or PARTIAL
  double mean_coverage_pct = 0.0;                   // over all runs
  RunStatistics ate_m, t_rel_pct, r_rel_deg_per_m;
  int min_segments = 0, max_segments = 0;
};

RowSummary SummarizeRow(const std::vector<Run>& all_runs) {
  std::vector<Run> runs;
  std::copy_if(all_runs.begin(), all_runs.end(), std::back_inserter(runs),
               [](const Run& run) { return !run.skipped; });
  RowSummary row;
  row.skipped = runs.empty();
  row.num_runs = static_cast<int>(runs.size());
  bool first_good = true;
  for (const Run& run : runs) {
    row.mean_coverage_pct += 100.0 * run.coverage / static_cast<double>(runs.size());
    if (IsFailure(run.status)) continue;
    ++row.num_good;
    if (run.status == RunStatus::kPartial) ++row.num_partial;
    row.min_segments = first_good ? run.segments : std::min(row.min_segments, run.segments);
    row.max_segments = std::max(row.max_segments, run.segments);
    first_good = false;
  }
  row.ate_m = Statistics(runs, &Run::ate_rmse_m);
  row.t_rel_pct = Statistics(runs, &Run::t_rel_pct);
  row.r_rel_deg_per_m = Statistics(runs, &Run::r_rel_deg_per_m);
  return row;
}

// X for a failed row, "-" for a skipped one, n/a where nothing was measured.
std::string Cell(const RowSummary& row, const RunStatistics& statistics, double value,
                 int decimals) {
  if (row.skipped) return "-";
  if (row.num_good == 0) return "X";
  if (statistics.num_used == 0) return "n/a";
  return fmt::format("{:.{}f}", value, decimals);
}

std::string Note(const RowSummary& row) {
  if (row.skipped) return "skipped";
  if (row.num_good == 0) return "X";
  std::string note;
  if (row.num_partial > 0) note = fmt::format("partial ({} of {})", row.num_partial, row.num_good);
  if (row.num_good < row.num_runs) {
    note += fmt::format("{}{} failed", note.empty() ? "" : ", ", row.num_runs - row.num_good);
  }
  return note;
}

std::string SegmentCount(const RowSummary& row) {
  if (row.num_good == 0) return row.skipped ? "-" : "X";
  return row.min_segments == row.max_segments
             ? std::to_string(row.min_segments)
             : fmt::format("{} to {}", row.min_segments, row.max_segments);
}

std::string MarkdownRow(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

// A name as the text of a table cell.
std::string MarkdownText(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '|') escaped += '\\';
    escaped += c == '\n' ? ' ' : c;
  }
  return escaped;
}

std::string MarkdownCells(const RowKey& key, const std::string& configuration,
                          const RowSummary& row) {
  const RunStatistics& ate = row.ate_m;
  const RunStatistics& rotation = row.r_rel_deg_per_m;
  return MarkdownRow({MarkdownText(key.dataset), MarkdownText(key.sequence),
                      MarkdownText(configuration), key.trajectory, key.gt_frame, key.alignment,
                      fmt::format("{}/{}", row.num_good, row.num_runs),
                      row.skipped ? "-" : fmt::format("{:.1f}", row.mean_coverage_pct),
                      Cell(row, ate, ate.mean, 4), Cell(row, ate, ate.median, 4),
                      Cell(row, ate, ate.min, 4), Cell(row, ate, ate.max, 4),
                      Cell(row, row.t_rel_pct, row.t_rel_pct.mean, 3),
                      Cell(row, rotation, 100.0 * rotation.mean, 4),
                      Cell(row, rotation, rotation.mean, 6), SegmentCount(row), Note(row)});
}

std::string Markdown(const Runs& runs) {
  const std::vector<std::string> header = {"dataset",
                                           "sequence",
                                           "configuration",
                                           "trajectory",
                                           "GT frame",
                                           "alignment",
                                           "runs used [k/n]",
                                           "coverage, mean of all runs [%]",
                                           "ATE RMSE mean [m]",
                                           "ATE RMSE median [m]",
                                           "ATE RMSE min [m]",
                                           "ATE RMSE max [m]",
                                           "t_rel mean [%]",
                                           "r_rel mean [deg/100 m]",
                                           "r_rel mean [deg/m]",
                                           "segments",
                                           "note"};
  std::string text = MarkdownRow(header);
  text += MarkdownRow(std::vector<std::string>(header.size(), "---"));
  for (const auto& [key, row_runs] : runs.rows) {
    text += MarkdownCells(key, ConfigurationText(runs, key), SummarizeRow(row_runs));
  }
  text +=
      "\nX: no run kept a pose for enough frames. -: skipped. partial: the number is of a part of "
      "the sequence and does not count as a win. Statistics are over the runs used (OK or "
      "partial).\n";
  for (const std::string& line : runs.settings) text += "\n" + line + "\n";
  return text;
}

std::string CsvText(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string CsvStatistics(const RunStatistics& s, double factor) {
  if (s.num_used == 0) return ",,,";
  return fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}", factor * s.mean, factor * s.median,
                     factor * s.min, factor * s.max);
}

std::string Csv(const Runs& runs) {
  std::string text =
      "dataset,sequence,configuration,trajectory,gt_frame,alignment,mark,runs,runs_used,"
      "runs_partial,coverage_mean_pct,ate_rmse_mean_m,ate_rmse_median_m,ate_rmse_min_m,"
      "ate_rmse_max_m,t_rel_mean_pct,t_rel_median_pct,t_rel_min_pct,t_rel_max_pct,"
      "r_rel_mean_deg_per_100m,r_rel_median_deg_per_100m,r_rel_min_deg_per_100m,"
      "r_rel_max_deg_per_100m,r_rel_mean_deg_per_m,r_rel_median_deg_per_m,r_rel_min_deg_per_m,"
      "r_rel_max_deg_per_m,segments_min,segments_max\n";
  for (const auto& [key, row_runs] : runs.rows) {
    const RowSummary row = SummarizeRow(row_runs);
    const char* mark = row.skipped         ? "-"
                       : row.num_good == 0 ? "X"
                       : row.num_partial   ? "partial"
                                           : "";
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},", CsvText(key.dataset),
                    CsvText(key.sequence), CsvText(ConfigurationText(runs, key)), key.trajectory,
                    key.gt_frame, key.alignment, mark, row.num_runs, row.num_good, row.num_partial,
                    row.skipped ? "" : fmt::format("{:.6g}", row.mean_coverage_pct));
    text +=
        fmt::format("{},{},{},{},{},{}\n", CsvStatistics(row.ate_m, 1.0),
                    CsvStatistics(row.t_rel_pct, 1.0), CsvStatistics(row.r_rel_deg_per_m, 100.0),
                    CsvStatistics(row.r_rel_deg_per_m, 1.0), row.min_segments, row.max_segments);
  }
  return text;
}

}  // namespace

std::vector<std::filesystem::path> FindResultFiles(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path)) return {path};
  if (!std::filesystem::is_directory(path)) {
    throw InputError(fmt::format("{}: no such file or folder", path.string()));
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    if (entry.is_regular_file() && entry.path().filename() == "result.json") {
      files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    throw InputError(fmt::format("{}: no result.json in the folder or below", path.string()));
  }
  std::sort(files.begin(), files.end());
  return files;
}

RunReport BuildReport(const std::vector<std::filesystem::path>& result_files) {
  const Runs runs = ReadRuns(result_files);
  return {Markdown(runs), Csv(runs)};
}

}  // namespace lift_slam
