#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lift_slam {

// A whole number without sign or fraction.
std::optional<std::int64_t> ParseIndex(std::string_view text);

// A double; NaN and infinity are accepted here and left to the caller. Values too small for a
// double are zero, values too large are refused.
std::optional<double> ParseDouble(std::string_view text);

}  // namespace lift_slam
