#include "lift_slam/datasets/decimal.h"

#include <charconv>
#include <chrono>
#include <limits>
#include <string>

namespace lift_slam {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
constexpr std::int64_t kMaxExponent = 1000;  // beyond it the value is zero or does not fit

struct Decimal {
  bool negative = false;
  std::string digits;         // without point and leading zeros
  std::int64_t exponent = 0;  // value = digits * 10^exponent
};

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::optional<std::int64_t> ParseWhole(std::string_view text) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || error != std::errc() || stop != end) return std::nullopt;
  return value;
}

// The part behind the 'e'.
std::optional<std::int64_t> ParseExponent(std::string_view text) {
  const bool plus = !text.empty() && text.front() == '+';
  if (plus) text.remove_prefix(1);
  if (plus && text.starts_with('-')) return std::nullopt;
  const std::optional<std::int64_t> value = ParseWhole(text);
  if (!value || *value > kMaxExponent || *value < -kMaxExponent) return std::nullopt;
  return value;
}

std::optional<Decimal> Split(std::string_view text) {
  Decimal decimal;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    decimal.negative = text.front() == '-';
    text.remove_prefix(1);
  }
  const std::size_t mark = text.find_first_of("eE");
  if (mark != std::string_view::npos) {
    const auto exponent = ParseExponent(text.substr(mark + 1));
    if (!exponent) return std::nullopt;
    decimal.exponent = *exponent;
    text = text.substr(0, mark);
  }
  bool any_digit = false, after_point = false;
  for (const char c : text) {
    if (c == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (!IsDigit(c)) return std::nullopt;
    any_digit = true;
    if (after_point) --decimal.exponent;
    if (c != '0' || !decimal.digits.empty()) decimal.digits.push_back(c);
  }
  if (!any_digit) return std::nullopt;
  return decimal;
}

}  // namespace

std::optional<std::int64_t> ParseScaledDecimal(std::string_view text, int shift) {
  std::optional<Decimal> decimal = Split(text);
  if (!decimal) return std::nullopt;
  if (decimal->digits.empty()) return 0;
  const std::int64_t exponent = decimal->exponent + shift;
  constexpr std::int64_t kMaxDigits = std::numeric_limits<std::int64_t>::digits10 + 1;
  const std::int64_t kept = static_cast<std::int64_t>(decimal->digits.size()) + exponent;
  if (kept < 0) return 0;
  if (kept > kMaxDigits) return std::nullopt;
  const bool round_up = exponent < 0 && decimal->digits[static_cast<std::size_t>(kept)] >= '5';
  std::string digits = decimal->digits;
  digits.resize(static_cast<std::size_t>(kept), '0');
  const std::optional<std::int64_t> cut = digits.empty() ? 0 : ParseWhole(digits);
  if (!cut || (round_up && *cut == std::numeric_limits<std::int64_t>::max())) return std::nullopt;
  const std::int64_t value = *cut + (round_up ? 1 : 0);
  return decimal->negative ? -value : value;
}

std::optional<std::int64_t> ParseDateAsNs(std::string_view date, std::string_view time_of_day) {
  if (date.size() != 10 || date[4] != '-' || date[7] != '-') return std::nullopt;
  if (time_of_day.size() < 8 || time_of_day[2] != ':' || time_of_day[5] != ':') return std::nullopt;
  const auto year = ParseIndex(date.substr(0, 4)), month = ParseIndex(date.substr(5, 2)),
             day = ParseIndex(date.substr(8, 2)), hour = ParseIndex(time_of_day.substr(0, 2)),
             minute = ParseIndex(time_of_day.substr(3, 2));
  const auto second_ns = ParseSecondsAsNs(time_of_day.substr(6));
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

std::optional<std::int64_t> ParseIndex(std::string_view text) {
  if (text.empty() || !IsDigit(text.front())) return std::nullopt;
  return ParseWhole(text);
}

std::optional<double> ParseDouble(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || stop != end) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Beyond the range of a double: tiny values (1e-400) count as zero, large ones are refused.
    const std::size_t mark = text.find_first_of("eE");
    const bool tiny = mark != std::string_view::npos && text[mark + 1] == '-';
    return tiny ? std::optional<double>(0.0) : std::nullopt;
  }
  return error == std::errc() ? std::optional<double>(value) : std::nullopt;
}

}  // namespace lift_slam
