#pragma once

#include <vector>

#include "apps/benchmark_plan.h"
#include "apps/benchmark_results.h"
#include "apps/benchmark_table_text.h"

namespace lift_slam {

// Tables of the ablation, a row a variant, a column a sequence: ATE RMSE (median of the runs; least
// to largest), coverage, time of a frame.
std::vector<ResultTable> AblationTables(const BenchmarkPlan& plan, const BenchmarkCells& cells);

}  // namespace lift_slam
