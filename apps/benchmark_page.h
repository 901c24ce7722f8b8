#pragma once

#include <string>
#include <vector>

#include "apps/benchmark_picture.h"
#include "apps/benchmark_plan.h"
#include "apps/benchmark_table_text.h"

namespace lift_slam {

// The HTML page of a benchmark, complete in itself: tables, all statistics, pictures, and the
// sentences that say what the marks mean and what is missing.
std::string BenchmarkPage(const BenchmarkPlan& plan, const std::vector<ResultTable>& tables,
                          const ResultTable& statistics,
                          const std::vector<BenchmarkPicture>& pictures,
                          const std::vector<std::string>& remarks);

}  // namespace lift_slam
