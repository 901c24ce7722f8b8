#pragma once

#include <cstddef>
#include <string>

#include "apps/benchmark_results.h"
#include "apps/benchmark_table_text.h"

namespace lift_slam {

enum class CellStatistic { kMean, kMedian, kRange };  // kRange: "least to largest", never best

// "3/5": runs that succeeded; "3/4 of 5": one is still to be run; "?": all are.
std::string RunsText(const BenchmarkCell& cell);

// What to know of a figure over runs of which some failed, are missing or kept a part of the
// frames: " (72 %) 3/5" with the mean coverage. Empty: nothing of that.
std::string RunMarks(const BenchmarkCell& cell);

// What a table says of a system on a sequence: a figure, or why there is none, and the marks of
// runs that failed or kept a part of the frames (BenchmarkTables). `cell` may be null.
TableEntry MakeEntry(const BenchmarkCell* cell, bool is_skipped, std::size_t figure,
                     CellStatistic statistic);

// Every column's least contender among our rows becomes bold.
void MarkBest(ResultTable& table);

}  // namespace lift_slam
