#pragma once

#include <filesystem>
#include <string>

#include "apps/benchmark_plan.h"

namespace lift_slam {

// Tables of a benchmark, one for each figure (ATE RMSE in m, t_rel in %, r_rel in deg/100 m):
// a row a system, a column a sequence and condition, means over the runs, best of ours in bold
// (only where all runs kept at least 90 % of the frames), other publications below; then all
// statistics. Marks: X all runs failed, "-" left out on purpose, "?" not run yet, "(p %)" mean
// coverage of a row with partial runs, "k/n" runs that succeeded.
struct BenchmarkTables {
  std::string markdown, csv, latex, html;
};

// `publications`: a file as configs/paper_results.yaml; empty: none. Throws InputError.
BenchmarkTables MakeBenchmarkTables(const BenchmarkPlan& plan, const std::filesystem::path& folder,
                                    const std::filesystem::path& publications);

}  // namespace lift_slam
