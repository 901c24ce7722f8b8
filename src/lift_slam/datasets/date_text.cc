#include "lift_slam/datasets/date_text.h"

#include <chrono>

#include "lift_slam/geometry/timestamp_text.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

}  // namespace

std::optional<std::int64_t> ParseDateAsNs(std::string_view date, std::string_view time_of_day) {
  if (date.size() != 10 || date[4] != '-' || date[7] != '-') return std::nullopt;
  if (time_of_day.size() < 8 || time_of_day[2] != ':' || time_of_day[5] != ':') return std::nullopt;
  const auto year = ParseIndex(date.substr(0, 4)), month = ParseIndex(date.substr(5, 2)),
             day = ParseIndex(date.substr(8, 2)), hour = ParseIndex(time_of_day.substr(0, 2)),
             minute = ParseIndex(time_of_day.substr(3, 2));
  const auto second_ns = ParseSeconds(time_of_day.substr(6));
  if (!year || !month || !day || !hour || !minute || !second_ns) return std::nullopt;
  const std::chrono::year_month_day calendar_day(std::chrono::year(static_cast<int>(*year)),
                                                 std::chrono::month(static_cast<unsigned>(*month)),
                                                 std::chrono::day(static_cast<unsigned>(*day)));
  if (!calendar_day.ok() || *year < 1700 || *year > 2200) return std::nullopt;
  if (*hour > 23 || *minute > 59 || *second_ns < 0 || *second_ns > 60 * kNsPerSecond) {
    return std::nullopt;
  }
  const std::int64_t days = std::chrono::sys_days(calendar_day).time_since_epoch().count();
  return (days * 86400 + *hour * 3600 + *minute * 60) * kNsPerSecond + *second_ns;
}

}  // namespace lift_slam
