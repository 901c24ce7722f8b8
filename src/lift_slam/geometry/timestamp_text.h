#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lift_slam {

// Decimal text to integer nanoseconds and back, exact: never through floating point, because a
// double at 1.4e18 ns has steps of 256 ns. Accepted: "12", "-0.5", "+1.4e9",
// "1.403715529112143517e+09". Digits below 1 ns are rounded, half away from zero.
// Nothing when the text is no decimal number or does not fit into 64 bits.
std::optional<std::int64_t> ParseSeconds(std::string_view text);
std::optional<std::int64_t> ParseNanoseconds(std::string_view text);

// "1403715529.112143517": always nine decimals, so that ParseSeconds gives the same stamp back.
std::string FormatSeconds(std::int64_t timestamp_ns);

}  // namespace lift_slam
