#pragma once

#include <filesystem>
#include <vector>

#include "apps/benchmark_picture.h"
#include "apps/benchmark_plan.h"
#include "apps/benchmark_tables.h"

namespace lift_slam {

// Matching of features on a sequence under a condition, over its pairs.
struct MatchingCell {
  std::string title, sequence, condition;
  std::vector<double> inliers;  // of each pair, ascending
  double mean_features = 0.0, mean_matches = 0.0, mean_inliers = 0.0;

  // Of the inliers, by linear interpolation; there is at least one pair.
  double Quantile(double share) const;
};

// Of all finished jobs of a plan of the suite "matching". Throws InputError naming the file.
std::vector<MatchingCell> ReadMatching(const BenchmarkPlan& plan,
                                       const std::filesystem::path& folder);

// For each sequence inliers against frame skip, and by gamma: means with the middle half of the
// pairs.
std::vector<BenchmarkPicture> MatchingPictures(const BenchmarkPlan& plan,
                                               const std::vector<MatchingCell>& cells);

// For each sequence mean inliers and share of inliers among the matches: a row features, a column a
// condition, the most in bold.
BenchmarkTables MatchingTables(const BenchmarkPlan& plan, const std::vector<MatchingCell>& cells,
                               const std::vector<BenchmarkPicture>& pictures);

}  // namespace lift_slam
