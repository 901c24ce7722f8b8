#pragma once

#include <string>
#include <vector>

#include "apps/benchmark_plan.h"
#include "apps/benchmark_results.h"

namespace lift_slam {

// Trajectories of another system, judged as ours are. `argument` is "NAME=FOLDER"; the folder holds
// a file for each sequence, SEQUENCE.txt, .tum, .kitti or .csv (MH_01_easy.txt is good for MH_01),
// as TUM, KITTI or EuRoC. A sequence without a file is left out. With several runs: FOLDER/1,
// FOLDER/2 and so on hold one each. The frames that are run count, each with the pose nearest to it
// or none; the job's settings of the evaluation hold. Throws InputError for a wrong argument, a
// folder without any such file, and a file that cannot be read or has nothing in common with the
// ground truth.
std::vector<BenchmarkRun> ReadExternalRuns(const std::string& argument, const BenchmarkPlan& plan);

}  // namespace lift_slam
