#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lift_slam {

// Least number of inserted, deleted, replaced or swapped neighbouring characters that turns one
// word into the other (optimal string alignment distance).
int EditDistance(std::string_view a, std::string_view b);

// The candidate with the least edit distance, the first among equals; empty without candidates.
std::string_view NearestName(std::string_view name, std::span<const std::string> candidates);

}  // namespace lift_slam
