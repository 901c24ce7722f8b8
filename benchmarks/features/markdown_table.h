#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "benchmarks/features/image_sets.h"

namespace lift_slam {

inline std::string Row(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

// Also on standard error: a table takes minutes.
inline std::string RowShown(const std::vector<std::string>& cells) {
  std::string row = Row(cells);
  fmt::print(stderr, "{}", row);
  return row;
}

inline std::string Header(const std::vector<std::string>& names) {
  std::vector<std::string> rule(names.size(), "---:");
  rule.front() = "---";
  return Row(names) + Row(rule);
}

// A column for each set.
inline std::string Header(const std::string& first, std::span<const ImageSet> sets) {
  std::vector<std::string> names{first};
  for (const ImageSet& set : sets) names.push_back(set.name);
  return Header(names);
}

}  // namespace lift_slam
