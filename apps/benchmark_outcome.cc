#include "apps/benchmark_outcome.h"

#include "apps/benchmark_figures.h"
#include "apps/benchmark_matching.h"

namespace lift_slam {

BenchmarkOutcome RunsOutcome(const BenchmarkPlan& plan, const std::vector<BenchmarkRun>& runs,
                             const std::filesystem::path& publications) {
  BenchmarkOutcome outcome{MakeBenchmarkPictures(plan, runs), {}};
  outcome.tables = MakeBenchmarkTables(plan, runs, publications, outcome.pictures);
  return outcome;
}

BenchmarkOutcome MatchingOutcome(const BenchmarkPlan& plan, const std::filesystem::path& folder) {
  const std::vector<MatchingCell> cells = ReadMatching(plan, folder);
  BenchmarkOutcome outcome{MatchingPictures(plan, cells), {}};
  outcome.tables = MatchingTables(plan, cells, outcome.pictures);
  return outcome;
}

}  // namespace lift_slam
