#pragma once

#include <filesystem>
#include <vector>

#include "apps/benchmark_picture.h"
#include "apps/benchmark_plan.h"
#include "apps/benchmark_results.h"
#include "apps/benchmark_tables.h"

namespace lift_slam {

// All that is shown of a benchmark's results.
struct BenchmarkOutcome {
  std::vector<BenchmarkPicture> pictures;
  BenchmarkTables tables;
};

// Of runs (MakeBenchmarkTables), and of the suite "matching" from the results in its folder.
BenchmarkOutcome RunsOutcome(const BenchmarkPlan& plan, const std::vector<BenchmarkRun>& runs,
                             const std::filesystem::path& publications);
BenchmarkOutcome MatchingOutcome(const BenchmarkPlan& plan, const std::filesystem::path& folder);

}  // namespace lift_slam
