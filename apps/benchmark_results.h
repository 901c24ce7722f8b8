#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/benchmark_plan.h"
#include "lift_slam/evaluation/run_statistics.h"
#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// A measured figure of a run.
struct BenchmarkFigure {
  const char* key;  // in the file of publications and in the CSV
  const char* title;
  const char* pointer;  // in result.json
  double factor;        // from there to the unit of the title
  int decimals;
};
inline constexpr std::array<BenchmarkFigure, 4> kBenchmarkFigures = {
    {{"ate_m", "ATE RMSE [m]", "/ate/rmse", 1.0, 3},
     {"t_rel_pct", "t_rel [%]", "/kitti/t_rel_pct", 1.0, 2},
     {"r_rel_deg_per_100m", "r_rel [deg/100 m]", "/kitti/r_rel_deg_per_m", 100.0, 2},
     // Extraction and tracking, mean over the frames.
     {"frame_ms", "Time of a frame [ms]", "/timing/frame_ms/mean_ms", 1.0, 1}}};
inline constexpr std::size_t kAteFigure = 0, kFrameTimeFigure = 3;
inline constexpr std::size_t kNumErrorFigures =
    3;  // the first ones; tables of the paper have these

// One run that has ended, of ours or of another system.
struct BenchmarkRun {
  std::string title, sequence, condition;  // condition: "none" or a distortion
  int seed = 0;
  RunStatus status = RunStatus::kFailInit;
  double coverage = 0.0;
  int frames_total = 0;
  std::string notice;  // what the features could not do as asked: "LIFT's descriptors in ..."
  std::array<std::optional<double>, kBenchmarkFigures.size()> figures;  // by kBenchmarkFigures
  std::filesystem::path folder;  // of our results; empty: a trajectory from outside
  Trajectory aligned;            // of a trajectory from outside; in the ground truth's frame
};

// Reads a result.json, or the same object from outside. Throws InputError naming the file.
BenchmarkRun RunFromResult(const std::string& json, const std::string& file);

// All runs of the plan that have ended, in its order.
std::vector<BenchmarkRun> ReadBenchmarkRuns(const BenchmarkPlan& plan,
                                            const std::filesystem::path& folder);

// The runs of a system on a sequence under a condition.
struct BenchmarkCell {
  int planned = 0;
  std::vector<const BenchmarkRun*> runs;  // that have ended

  int NumGood() const;     // OK or partial
  bool HasFailed() const;  // all runs have ended, and none is good
  double MeanCoverage() const;
  RunStatistics Statistics(std::size_t figure) const;
};

// A column: sequence and condition as one key, "03 gamma=2".
std::string ColumnKey(const std::string& sequence, const std::string& condition);
// Of every sequence and condition of the plan, in its order.
std::vector<std::string> ColumnKeys(const BenchmarkPlan& plan);

// By title and column. The runs must outlive it.
using BenchmarkCells = std::map<std::pair<std::string, std::string>, BenchmarkCell>;
BenchmarkCells SortIntoCells(const BenchmarkPlan& plan, const std::vector<BenchmarkRun>& runs);

// A sequence of KITTI or EuRoC of which only a part was run.
struct BenchmarkExcerpt {
  std::string sequence;
  int frames = 0, published_frames = 0;
};
std::vector<BenchmarkExcerpt> FindExcerpts(const BenchmarkPlan& plan,
                                           const std::vector<BenchmarkRun>& runs);

}  // namespace lift_slam
