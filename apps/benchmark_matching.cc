#include "apps/benchmark_matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/benchmark_entry.h"
#include "apps/benchmark_jobs.h"
#include "apps/benchmark_page.h"
#include "apps/benchmark_table_text.h"
#include "apps/sequence_pairs.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Json = nlohmann::json;

MatchingCell ReadCell(const BenchmarkJob& job, const std::string& condition, const Json& pairs) {
  MatchingCell cell{job.title, job.sequence, condition, {}};
  for (const Json& pair : pairs) {
    cell.inliers.push_back(pair.at("inliers").get<double>());
    cell.mean_inliers += cell.inliers.back();
    cell.mean_matches += pair.at("matches").get<double>();
    cell.mean_features += pair.at("features_b").get<double>();
  }
  std::ranges::sort(cell.inliers);
  const auto count = static_cast<double>(cell.inliers.size());
  for (double* mean : {&cell.mean_inliers, &cell.mean_matches, &cell.mean_features}) *mean /= count;
  return cell;
}

void ReadJob(const BenchmarkJob& job, const std::filesystem::path& file,
             std::vector<MatchingCell>& cells) {
  try {
    const Json json = Json::parse(ReadText(file));
    for (const std::string& condition : PairConditions()) {
      const Json& pairs = json.at("conditions").at(condition);
      if (!pairs.empty()) cells.push_back(ReadCell(job, condition, pairs));
    }
  } catch (const Json::exception&) {
    throw InputError(fmt::format("{}: is no result of match-sequence", file.string()));
  }
}

const MatchingCell* Find(const std::vector<MatchingCell>& cells, const std::string& title,
                         const std::string& sequence, const std::string& condition) {
  const auto found = std::ranges::find_if(cells, [&](const MatchingCell& cell) {
    return cell.title == title && cell.sequence == sequence && cell.condition == condition;
  });
  return found == cells.end() ? nullptr : &*found;
}

// `value` of each cell; the largest of a column in bold.
template <class Value>
ResultTable MakeTable(const BenchmarkPlan& plan, const std::vector<MatchingCell>& cells,
                      const std::string& sequence, std::string title, const Value& value) {
  ResultTable table{std::move(title), plan.conditions, {}, {}};
  for (const std::string& features : plan.titles) {
    BenchmarkTableRow row{features, {}};
    for (const std::string& condition : plan.conditions) {
      const MatchingCell* cell = Find(cells, features, sequence, condition);
      row.entries.push_back(cell == nullptr ? TableEntry{"?", {}}
                                            : TableEntry{fmt::format("{:.0f}", value(*cell)), {}});
      if (cell != nullptr) row.entries.back().contender = -value(*cell);  // the least wins
    }
    table.ours.push_back(std::move(row));
  }
  MarkBest(table);
  return table;
}

double InlierShare(const MatchingCell& cell) {
  return cell.mean_matches > 0.0 ? 100.0 * cell.mean_inliers / cell.mean_matches : 0.0;
}

std::string Csv(const std::vector<MatchingCell>& cells) {
  std::string text =
      "suite,features,sequence,condition,pairs,features_mean,matches_mean,inliers_mean,"
      "inliers_min,inliers_p25,inliers_median,inliers_p75,inliers_max\n";
  for (const MatchingCell& cell : cells) {
    text += fmt::format(
        "matching,\"{}\",\"{}\",{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},"
        "{:.9g},{:.9g}\n",
        cell.title, cell.sequence, cell.condition, cell.inliers.size(), cell.mean_features,
        cell.mean_matches, cell.mean_inliers, cell.inliers.front(), cell.Quantile(0.25),
        cell.Quantile(0.5), cell.Quantile(0.75), cell.inliers.back());
  }
  return text;
}

// Mean, and the middle half of the pairs.
ResultTable StatisticsTable(const BenchmarkPlan& plan, const std::vector<MatchingCell>& cells) {
  const std::vector<std::string> shown = {"t+1", "t+5", "t+10", "gamma=0.25", "gamma=4"};
  ResultTable table{"Sequence, features: inliers (quartiles)", {"pairs", "features"}, {}, {}};
  table.columns.insert(table.columns.end(), shown.begin(), shown.end());
  for (const std::string& sequence : plan.sequences) {
    for (const std::string& features : plan.titles) {
      const MatchingCell* first = Find(cells, features, sequence, shown.front());
      if (first == nullptr) continue;
      BenchmarkTableRow row{sequence + ", " + features, {}};
      row.entries.push_back({fmt::format("{}", first->inliers.size()), {}});
      row.entries.push_back({fmt::format("{:.0f}", first->mean_features), {}});
      for (const std::string& condition : shown) {
        const MatchingCell* cell = Find(cells, features, sequence, condition);
        row.entries.push_back({cell == nullptr
                                   ? "?"
                                   : fmt::format("{:.0f} ({:.0f} to {:.0f})", cell->mean_inliers,
                                                 cell->Quantile(0.25), cell->Quantile(0.75)),
                               {}});
      }
      table.ours.push_back(std::move(row));
    }
  }
  return table;
}

std::vector<std::string> Remarks(const BenchmarkPlan& plan) {
  std::vector<std::string> remarks = {fmt::format(
      "Revision {}. Mutual nearest descriptors of two images; inliers fulfil the epipolar geometry "
      "that most of them fulfil, within 2 pixels (the essential matrix where the sequence has a "
      "calibration, else the fundamental matrix). t+K: K frames apart. gamma: the second image, {} "
      "frames after the first, is 255 (I / 255)^gamma; t+{} is the same without. {} first images "
      "at most, spread evenly over each sequence. Bold: the most. ?: not run.",
      plan.revision, kGammaSkip, kGammaSkip, plan.jobs.empty() ? 0 : plan.jobs.front().pairs)};
  if (!plan.frames.empty()) {
    remarks.push_back(fmt::format("Only frames {} of each sequence were used.", plan.frames));
  }
  return remarks;
}

}  // namespace

double MatchingCell::Quantile(double share) const {
  const double at = share * static_cast<double>(inliers.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, inliers.size() - 1);
  return std::lerp(inliers[below], inliers[above], at - static_cast<double>(below));
}

std::vector<MatchingCell> ReadMatching(const BenchmarkPlan& plan,
                                       const std::filesystem::path& folder) {
  std::vector<MatchingCell> cells;
  for (const BenchmarkJob& job : plan.jobs) {
    if (IsFinished(folder, job)) ReadJob(job, ResultFolder(folder, job) / "result.json", cells);
  }
  return cells;
}

BenchmarkTables MatchingTables(const BenchmarkPlan& plan, const std::vector<MatchingCell>& cells,
                               const std::vector<BenchmarkPicture>& pictures) {
  std::vector<ResultTable> tables;
  for (const std::string& sequence : plan.sequences) {
    tables.push_back(MakeTable(plan, cells, sequence, sequence + ": inliers, mean of the pairs",
                               [](const MatchingCell& cell) { return cell.mean_inliers; }));
    tables.push_back(
        MakeTable(plan, cells, sequence, sequence + ": inliers among matches [%]", InlierShare));
  }
  const ResultTable statistics = StatisticsTable(plan, cells);
  const std::vector<std::string> remarks = Remarks(plan);
  std::string latex;
  for (const ResultTable& table : tables) latex += LatexTable(table);
  return CompleteTexts({.csv = Csv(cells), .latex = latex}, plan, tables, statistics, remarks,
                       pictures);
}

}  // namespace lift_slam
