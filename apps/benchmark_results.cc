#include "apps/benchmark_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/benchmark_data.h"
#include "apps/benchmark_jobs.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

using Json = nlohmann::json;

// Copies of a dataset may lack a few frames at the ends.
constexpr double kWholeShare = 0.95;

RunStatus StatusOf(const std::string& name) {
  for (const RunStatus status : {RunStatus::kOk, RunStatus::kPartial, RunStatus::kFailLost}) {
    if (Name(status) == name) return status;
  }
  return RunStatus::kFailInit;
}

std::optional<double> NumberAt(const Json& json, const char* pointer) {
  const Json::json_pointer p(pointer);
  if (!json.contains(p) || !json.at(p).is_number()) return std::nullopt;
  return json.at(p).get<double>();
}

// A line of a run's log about its descriptors; empty: there is none.
std::string NoticeIn(const std::filesystem::path& log) {
  constexpr const char* kBeginning = "LIFT's descriptors in ";
  if (!std::filesystem::is_regular_file(log)) return {};
  for (const std::string& line : ReadLines(log)) {
    const std::size_t at = line.find(kBeginning);
    if (at != std::string::npos) return line.substr(at);
  }
  return {};
}

}  // namespace

BenchmarkRun RunFromResult(const std::string& text, const std::string& file) {
  const Json json = Json::parse(text, nullptr, /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains("status") || !json["status"].is_string()) {
    throw InputError(fmt::format("{}: is no result of a run", file));
  }
  BenchmarkRun run;
  run.status = StatusOf(json["status"].get<std::string>());
  run.coverage = NumberAt(json, "/coverage/coverage").value_or(0.0);
  run.frames_total = static_cast<int>(NumberAt(json, "/coverage/frames_total").value_or(0.0));
  for (std::size_t i = 0; i < kBenchmarkFigures.size(); ++i) {
    const auto value = NumberAt(json, kBenchmarkFigures[i].pointer);
    if (value) run.figures[i] = kBenchmarkFigures[i].factor * *value;
  }
  return run;
}

std::vector<BenchmarkRun> ReadBenchmarkRuns(const BenchmarkPlan& plan,
                                            const std::filesystem::path& folder) {
  std::vector<BenchmarkRun> runs;
  for (const BenchmarkJob& job : plan.jobs) {
    if (!IsFinished(folder, job)) continue;
    const std::filesystem::path results = ResultFolder(folder, job);
    BenchmarkRun run =
        RunFromResult(ReadText(results / "result.json"), (results / "result.json").string());
    run.title = job.title;
    run.sequence = job.sequence;
    run.condition = job.Condition();
    run.seed = job.seed;
    run.folder = results;
    run.notice = NoticeIn(results / "log.txt");
    runs.push_back(std::move(run));
  }
  return runs;
}

int BenchmarkCell::NumGood() const {
  return static_cast<int>(
      std::ranges::count_if(runs, [](const auto* run) { return !IsFailure(run->status); }));
}

bool BenchmarkCell::HasFailed() const {
  return NumGood() == 0 && !runs.empty() && static_cast<int>(runs.size()) >= planned;
}

double BenchmarkCell::MeanCoverage() const {
  double sum = 0.0;
  for (const BenchmarkRun* run : runs) sum += run->coverage;
  return runs.empty() ? 0.0 : sum / static_cast<double>(runs.size());
}

RunStatistics BenchmarkCell::Statistics(std::size_t figure) const {
  std::vector<RunOutcome> outcomes;
  for (const BenchmarkRun* run : runs) outcomes.push_back({run->status, run->figures[figure]});
  return SummarizeRuns(outcomes);
}

std::string ColumnKey(const std::string& sequence, const std::string& condition) {
  return condition == "none" || condition.empty() ? sequence : sequence + " " + condition;
}

std::vector<std::string> ColumnKeys(const BenchmarkPlan& plan) {
  std::vector<std::string> keys;
  for (const std::string& sequence : plan.sequences) {
    for (const std::string& condition : plan.conditions) {
      keys.push_back(ColumnKey(sequence, condition));
    }
  }
  return keys;
}

BenchmarkCells SortIntoCells(const BenchmarkPlan& plan, const std::vector<BenchmarkRun>& runs) {
  BenchmarkCells cells;
  for (const BenchmarkJob& job : plan.jobs) {
    ++cells[{job.title, ColumnKey(job.sequence, job.distortion)}].planned;
  }
  for (const BenchmarkRun& run : runs) {
    BenchmarkCell& cell = cells[{run.title, ColumnKey(run.sequence, run.condition)}];
    cell.runs.push_back(&run);
    cell.planned = std::max(cell.planned, static_cast<int>(cell.runs.size()));
  }
  return cells;
}

std::vector<BenchmarkExcerpt> FindExcerpts(const BenchmarkPlan& plan,
                                           const std::vector<BenchmarkRun>& runs) {
  std::vector<BenchmarkExcerpt> excerpts;
  if (plan.suite == "rendered" || plan.suite == "shared" || plan.suite == "ablation") {
    return excerpts;
  }
  for (const std::string& sequence : plan.sequences) {
    BenchmarkExcerpt excerpt{sequence, 0, PublishedFrames(sequence)};
    for (const BenchmarkRun& run : runs) {
      if (run.sequence == sequence) excerpt.frames = std::max(excerpt.frames, run.frames_total);
    }
    const bool is_excerpt =
        excerpt.frames > 0 && excerpt.frames < kWholeShare * excerpt.published_frames;
    if (is_excerpt) excerpts.push_back(excerpt);
  }
  return excerpts;
}

}  // namespace lift_slam
