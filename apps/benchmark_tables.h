#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/benchmark_figures.h"
#include "apps/benchmark_plan.h"
#include "apps/benchmark_results.h"
#include "apps/benchmark_table_text.h"

namespace lift_slam {

// Tables of a benchmark, one for each figure (ATE RMSE in m, t_rel in %, r_rel in deg/100 m):
// a row a system, a column a sequence, means over the runs, best of ours in bold (only where all
// runs kept at least 90 % of the frames), other publications below. With several conditions a row
// is a sequence and condition and a column a system (the paper's Table 4), best of the row in bold.
// Last all statistics. Marks: X all runs failed, "-" left out on purpose, "?" not run yet, or not
// all and none succeeded, "(p %)" mean coverage of a row with partial runs, "k/n" runs that
// succeeded, "k/n of m" where of m planned ones n have ended.
struct BenchmarkTables {
  std::string markdown = {}, csv = {}, latex = {}, html = {};  // html: a page, with the pictures
};

// `texts` has the CSV and the LaTeX of `tables`; the statistics, the remarks and the other forms
// are added.
BenchmarkTables CompleteTexts(BenchmarkTables texts, const BenchmarkPlan& plan,
                              const std::vector<ResultTable>& tables, const ResultTable& statistics,
                              const std::vector<std::string>& remarks,
                              const std::vector<BenchmarkPicture>& pictures);

// `runs`: those of the plan and of systems from outside, whose titles are in plan.titles.
// `publications`: a file as configs/paper_results.yaml; empty: none. Throws InputError.
BenchmarkTables MakeBenchmarkTables(const BenchmarkPlan& plan,
                                    const std::vector<BenchmarkRun>& runs,
                                    const std::filesystem::path& publications,
                                    const std::vector<BenchmarkPicture>& pictures);

}  // namespace lift_slam
