#pragma once

#include <vector>

#include "apps/benchmark_picture.h"
#include "apps/benchmark_plan.h"
#include "apps/benchmark_results.h"

namespace lift_slam {

// In this order: trajectories of each sequence with ground truth, the first run of each system (not
// the best); mean ATE by condition where there are several; adaptive thresholds of each frame
// (paper Fig. 5), first run again. Of the ablation: ATE by variant alone. What has no data gives no
// figure.
std::vector<BenchmarkPicture> MakeBenchmarkPictures(const BenchmarkPlan& plan,
                                                    const std::vector<BenchmarkRun>& runs);

}  // namespace lift_slam
