#include "apps/benchmark_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "apps/benchmark_entry.h"
#include "apps/benchmark_truth.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/number_text.h"
#include "lift_slam/visualization/dot_chart.h"
#include "lift_slam/visualization/svg_plot.h"

namespace lift_slam {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

// Ink and grey are the truth's; after these the colours begin again.
constexpr PlotColor kColors[] = {PlotColor::kBlue,   PlotColor::kVermilion, PlotColor::kGreen,
                                 PlotColor::kOrange, PlotColor::kPurple,    PlotColor::kSky,
                                 PlotColor::kInk};

PlotColor ColorOf(const BenchmarkPlan& plan, const std::string& title) {
  const auto at = std::ranges::find(plan.titles, title) - plan.titles.begin();
  return kColors[static_cast<std::size_t>(at) % std::size(kColors)];
}

// The first that ended, of a system on a sequence as it is.
const BenchmarkRun* FirstRun(const std::vector<BenchmarkRun>& runs, const std::string& title,
                             const std::string& sequence) {
  const BenchmarkRun* first = nullptr;
  for (const BenchmarkRun& run : runs) {
    const bool fits = run.title == title && run.sequence == sequence && run.condition == "none";
    if (fits && (first == nullptr || run.seed < first->seed)) first = &run;
  }
  return first;
}

Trajectory AlignedPoses(const BenchmarkRun& run) {
  if (run.folder.empty()) return run.aligned;
  const auto file = run.folder / "trajectory_aligned.tum";
  if (!std::filesystem::is_regular_file(file)) return {};
  return ReadTrajectory(file).trajectory;
}

// A pose much later than the one before begins a new line.
PlotSeries Path(const Trajectory& poses, TopView view, std::string label, PlotColor color,
                double width_px) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    steps.push_back(poses[i].timestamp_ns - poses[i - 1].timestamp_ns);
  }
  std::vector<std::int64_t> sorted = steps;
  std::ranges::sort(sorted);
  const std::int64_t usual = sorted.empty() ? 0 : sorted[sorted.size() / 2];
  PlotSeries series{std::move(label), SeriesKind::kLine, color, {}, {}, width_px};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (poses[i].state != PoseState::kOk) continue;
    if (i > 0 && usual > 0 && steps[i - 1] > 5 * usual) {
      series.x.push_back(kGap);
      series.y.push_back(kGap);
    }
    const Eigen::Vector3d& p = poses[i].world_from_cam.translation;
    series.x.push_back(p.x());
    series.y.push_back(view == TopView::kXZ ? p.z() : p.y());
  }
  return series;
}

// Truth outside the time of every estimate is of frames that were not run.
void CutToEstimates(const std::vector<PlotSeries>& series, const std::vector<Trajectory>& estimates,
                    BenchmarkTruth& truth) {
  if (series.empty() || truth.by_index) return;
  std::int64_t begin = std::numeric_limits<std::int64_t>::max(), end = 0;
  for (const Trajectory& estimate : estimates) {
    if (estimate.empty()) continue;
    begin = std::min(begin, estimate.front().timestamp_ns);
    end = std::max(end, estimate.back().timestamp_ns);
  }
  std::erase_if(truth.poses, [&](const TrajectoryPose& pose) {
    return pose.timestamp_ns < begin || pose.timestamp_ns > end;
  });
}

void AddTrajectories(const BenchmarkPlan& plan, const std::vector<BenchmarkRun>& runs,
                     const std::string& sequence, std::vector<BenchmarkPicture>& pictures) {
  const auto job = std::ranges::find(plan.jobs, sequence, &BenchmarkJob::sequence);
  if (job == plan.jobs.end()) return;
  auto truth = LoadBenchmarkTruth(*job);
  if (!truth || truth->poses.empty()) return;
  Plot plot;
  plot.description = "Trajectories on " + sequence + " from above";
  plot.equal_aspect = true;
  plot.height_px = 430;
  const bool is_xz = truth->view == TopView::kXZ;
  plot.x.label = "x [m]";
  plot.y.label = is_xz ? "z [m]" : "y [m]";
  std::vector<PlotSeries> paths;
  std::vector<Trajectory> estimates;
  std::string failed;
  for (const std::string& title : plan.titles) {
    const BenchmarkRun* run = FirstRun(runs, title, sequence);
    if (run == nullptr) continue;
    const Trajectory poses = IsFailure(run->status) ? Trajectory() : AlignedPoses(*run);
    if (poses.empty()) failed += (failed.empty() ? "" : ", ") + title;
    if (poses.empty()) continue;
    paths.push_back(Path(poses, truth->view, title, ColorOf(plan, title), 1.5));
    estimates.push_back(poses);
  }
  if (paths.empty()) return;
  CutToEstimates(paths, estimates, *truth);
  plot.series.push_back(Path(truth->poses, truth->view, "ground truth", PlotColor::kGray, 4.0));
  plot.series.insert(plot.series.end(), paths.begin(), paths.end());
  std::string note = failed.empty() ? "" : "Failed, not drawn: " + failed + ".";
  pictures.push_back(MakePicture("Trajectories, first run of each system", "trajectory_" + sequence,
                                 sequence, std::move(note), plot));
}

// Mean over the runs; failed when all have ended and none succeeded.
double ConditionValue(const BenchmarkCells& cells, const std::string& title,
                      const std::string& column) {
  const auto found = cells.find({title, column});
  if (found == cells.end() || found->second.runs.empty()) return DotSeries::kNone;
  if (found->second.HasFailed()) return DotSeries::kFailed;
  const RunStatistics statistics = found->second.Statistics(0);
  return statistics.num_used == 0 ? DotSeries::kNone : statistics.mean;
}

// Adds a dot's name when it is not of all runs with all frames.
void AddMarks(const BenchmarkCells& cells, const std::string& title, const std::string& column,
              const std::string& name, std::vector<std::string>& marked) {
  const auto found = cells.find({title, column});
  if (found == cells.end() || found->second.NumGood() == 0) return;
  const std::string marks = RunMarks(found->second);
  if (!marks.empty()) marked.push_back(name + marks);
}

std::string MarksNote(const std::vector<std::string>& marked) {
  if (marked.empty()) return {};
  return fmt::format("Of a part of the runs or frames: {}.", fmt::join(marked, "; "));
}

void AddConditions(const BenchmarkPlan& plan, const BenchmarkCells& cells,
                   const std::string& sequence, std::vector<BenchmarkPicture>& pictures) {
  DotChart chart;
  chart.description = "Error on " + sequence + " under each condition";
  chart.axis.label = "ATE RMSE, mean of the runs [m]";
  chart.categories = plan.conditions;
  bool has_value = false;
  std::vector<std::string> marked;
  for (const std::string& title : plan.titles) {
    DotSeries series{title, ColorOf(plan, title), {}};
    bool is_known = false;
    for (const std::string& condition : plan.conditions) {
      const std::string column = ColumnKey(sequence, condition);
      series.values.push_back(ConditionValue(cells, title, column));
      AddMarks(cells, title, column, title + ", " + condition, marked);
      is_known = is_known || !std::isnan(series.values.back());
    }
    if (is_known) chart.series.push_back(std::move(series));
    has_value = has_value || is_known;
  }
  if (!has_value) return;
  std::ranges::replace(chart.categories, "none", "undistorted");
  pictures.push_back(
      MakePicture("ATE by condition", "ate_" + sequence, sequence, MarksNote(marked), chart));
}

// Variants one under another: median of the runs, and a bar from the least to the largest.
void AddVariants(const BenchmarkPlan& plan, const BenchmarkCells& cells, const std::string& column,
                 std::vector<BenchmarkPicture>& pictures) {
  DotChart chart;
  chart.description = "Error of each variant on " + column;
  chart.axis.label = "ATE RMSE [m]";
  chart.categories = plan.titles;
  chart.width_px = 720;
  DotSeries series{"median", PlotColor::kBlue, {}};
  std::vector<std::string> marked;
  for (const std::string& title : plan.titles) {
    AddMarks(cells, title, column, title, marked);
    const double mean = ConditionValue(cells, title, column);
    const auto found = cells.find({title, column});
    const RunStatistics s =
        found == cells.end() ? RunStatistics() : found->second.Statistics(kAteFigure);
    series.values.push_back(std::isfinite(mean) ? s.median : mean);
    series.low.push_back(std::isfinite(mean) ? s.min : DotSeries::kNone);
    series.high.push_back(std::isfinite(mean) ? s.max : DotSeries::kNone);
  }
  if (std::ranges::all_of(series.values, [](double value) { return std::isnan(value); })) return;
  chart.series = {std::move(series)};
  std::string note = "Median of the runs; bar: least to largest.";
  if (!marked.empty()) note += fmt::format(" {}", MarksNote(marked));
  pictures.push_back(
      MakePicture("ATE of each variant", "ate_" + column, column, std::move(note), chart));
}

// Columns of frames.csv by name.
struct ThresholdColumns {
  std::vector<double> frame, low, high;
};

std::vector<std::string> Words(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == ',') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

ThresholdColumns ReadThresholds(const std::filesystem::path& file) {
  ThresholdColumns columns;
  if (!std::filesystem::is_regular_file(file)) return columns;
  const std::vector<std::string> lines = ReadLines(file);
  const std::vector<std::string> header = Words(lines.empty() ? "" : lines.front());
  const auto column_of = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(header, name) - header.begin());
  };
  const std::size_t frame = column_of("frame"), low = column_of("low_threshold"),
                    high = column_of("high_threshold");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> words = Words(lines[i]);
    if (std::max({frame, low, high}) >= words.size()) continue;
    const double high_value = ParseDouble(words[high]).value_or(0.0);
    const bool is_tracked = high_value > 0.0;
    columns.frame.push_back(ParseDouble(words[frame]).value_or(kGap));
    columns.low.push_back(is_tracked ? ParseDouble(words[low]).value_or(kGap) : kGap);
    columns.high.push_back(is_tracked ? high_value : kGap);
  }
  return columns;
}

bool Varies(const std::vector<double>& values) {
  std::set<double> different;
  for (const double value : values) {
    if (std::isfinite(value)) different.insert(value);
  }
  return different.size() > 1;
}

void AddThresholds(const std::vector<BenchmarkRun>& runs, const std::string& title,
                   const std::string& sequence, std::vector<BenchmarkPicture>& pictures) {
  const BenchmarkRun* run = FirstRun(runs, title, sequence);
  if (run == nullptr || run->folder.empty()) return;
  const ThresholdColumns columns = ReadThresholds(run->folder / "frames.csv");
  if (!Varies(columns.high)) return;  // fixed
  Plot plot;
  plot.description = fmt::format("Matching thresholds of {} on {}", title, sequence);
  plot.height_px = 220;
  plot.x = {"frame", /*integers=*/true, {}, {}};
  plot.y = {"descriptor distance", false, 0.0, {}};
  plot.series = {
      {"high (guided)", SeriesKind::kLine, PlotColor::kVermilion, columns.frame, columns.high, 1.5},
      {"low (strict)", SeriesKind::kLine, PlotColor::kBlue, columns.frame, columns.low, 1.5}};
  pictures.push_back(MakePicture("Adaptive thresholds, first run of each system",
                                 "thresholds_" + sequence + "_" + title, title + ", " + sequence,
                                 "", plot));
}

}  // namespace

std::vector<BenchmarkPicture> MakeBenchmarkPictures(const BenchmarkPlan& plan,
                                                    const std::vector<BenchmarkRun>& runs) {
  std::vector<BenchmarkPicture> pictures;
  const BenchmarkCells cells = SortIntoCells(plan, runs);
  if (plan.suite == "ablation") {
    for (const std::string& sequence : plan.sequences) {
      for (const std::string& condition : plan.conditions) {
        AddVariants(plan, cells, ColumnKey(sequence, condition), pictures);
      }
    }
    return pictures;
  }
  for (const std::string& sequence : plan.sequences) {
    AddTrajectories(plan, runs, sequence, pictures);
  }
  for (const std::string& sequence : plan.sequences) {
    if (plan.conditions.size() > 1) AddConditions(plan, cells, sequence, pictures);
  }
  for (const std::string& sequence : plan.sequences) {
    for (const std::string& title : plan.titles) AddThresholds(runs, title, sequence, pictures);
  }
  return pictures;
}

}  // namespace lift_slam
