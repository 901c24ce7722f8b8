#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/benchmark_plan.h"
#include "apps/benchmark_results.h"

namespace lift_slam {

// A figure of a benchmark, as it stands in the page and as a file.
struct BenchmarkPicture {
  std::string section;    // heading it belongs under
  std::string file_name;  // "trajectory_00.svg"
  std::string title, note;
  std::string svg;       // element; its colours come from PlotStyleSheet()
  std::string svg_file;  // a file of its own
};

// In this order: trajectories of each sequence with ground truth, the first run of each system (not
// the best); mean ATE by condition where there are several; adaptive thresholds of each frame
// (paper Fig. 5), first run again. Of the ablation: ATE by variant alone. What has no data gives no
// figure.
std::vector<BenchmarkPicture> MakeBenchmarkPictures(const BenchmarkPlan& plan,
                                                    const std::vector<BenchmarkRun>& runs);

}  // namespace lift_slam
