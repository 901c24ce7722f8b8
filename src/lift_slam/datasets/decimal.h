#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lift_slam {

// Numbers from text. Times never pass through a double, which at 1.4e18 ns has a step of 256 ns.

// The exact value of decimal text ("12", "-0.5", "1.037359e-01") times 10^shift, as an integer;
// digits beyond it are rounded to the nearest, halves away from zero. Nothing when the text is no
// finite decimal number or the result does not fit.
std::optional<std::int64_t> ParseScaledDecimal(std::string_view text, int shift);

// A time in seconds as nanoseconds.
inline std::optional<std::int64_t> ParseSecondsAsNs(std::string_view text) {
  return ParseScaledDecimal(text, 9);
}

// "2011-09-26 13:02:25.964389445" (UTC) as nanoseconds since 1970, the fraction optional.
std::optional<std::int64_t> ParseDateAsNs(std::string_view date, std::string_view time_of_day);

// A whole number without sign or fraction.
std::optional<std::int64_t> ParseIndex(std::string_view text);

// A double; NaN and infinity are accepted here and left to the caller.
std::optional<double> ParseDouble(std::string_view text);

}  // namespace lift_slam
