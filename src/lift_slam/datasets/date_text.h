#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lift_slam {

// "2011-09-26 13:02:25.964389445" (UTC) as nanoseconds since 1970, the fraction optional.
std::optional<std::int64_t> ParseDateAsNs(std::string_view date, std::string_view time_of_day);

}  // namespace lift_slam
