#pragma once

#include <filesystem>

#include "apps/benchmark_plan.h"

namespace lift_slam {

enum class JobOutcome { kFinished, kWasFinished, kFailed, kStopped };

// Where the results of a finished job are: `folder`/results/HASH.
std::filesystem::path ResultFolder(const std::filesystem::path& folder, const BenchmarkJob& job);
bool IsFinished(const std::filesystem::path& folder, const BenchmarkJob& job);

struct BatchResult {
  int finished = 0, were_finished = 0, failed = 0;
  bool stopped = false;
};

// Runs the jobs that have no results yet, `num_parallel` at a time, each as `lift_slam run` in a
// process of its own below `folder`/running (a folder for each process: several may share the work,
// and what killed ones left is removed); a finished job's folder is renamed into place. What a
// job prints is in console.txt; the folder of one that failed goes to `folder`/failed and is tried
// again the next time. SIGINT and SIGTERM end the batch; unfinished jobs begin anew the next time.
// Runs keep features in `feature_cache`, unless it is empty.
BatchResult RunJobs(const std::vector<BenchmarkJob>& jobs, const std::filesystem::path& folder,
                    int num_parallel, const std::filesystem::path& feature_cache = {});

}  // namespace lift_slam
