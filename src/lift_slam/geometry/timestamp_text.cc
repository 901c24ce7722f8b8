#include "lift_slam/geometry/timestamp_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>

namespace lift_slam {
namespace {

constexpr int kMaxIntegerDigits = 19;  // of an int64
constexpr int kMaxExponent = 1000;     // far outside any time; keeps the sums below small

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// A decimal number taken apart: sign * digits * 10^exponent, without leading zeros.
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

bool TakeSign(std::string_view& text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  return negative;
}

// The exponent after 'e'; nothing when malformed or absurd.
std::optional<int> ParseExponent(std::string_view text) {
  const bool negative = TakeSign(text);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || !IsDigit(text.front()) || error != std::errc() ||
      end != text.data() + text.size() || value > kMaxExponent) {
    return std::nullopt;
  }
  return negative ? -value : value;
}

std::optional<Decimal> ParseDecimal(std::string_view text) {
  Decimal decimal;
  decimal.negative = TakeSign(text);
  bool has_digit = false;
  bool after_point = false;
  std::size_t i = 0;
  for (; i < text.size() && (IsDigit(text[i]) || (text[i] == '.' && !after_point)); ++i) {
    if (text[i] == '.') {
      after_point = true;
      continue;
    }
    has_digit = true;
    if (after_point) --decimal.exponent;
    if (text[i] != '0' || !decimal.digits.empty()) decimal.digits.push_back(text[i]);
  }
  if (!has_digit) return std::nullopt;
  if (i == text.size()) return decimal;
  if (text[i] != 'e' && text[i] != 'E') return std::nullopt;
  const std::optional<int> exponent = ParseExponent(text.substr(i + 1));
  if (!exponent) return std::nullopt;
  decimal.exponent += *exponent;
  return decimal;
}

// value * 10 + digit; nothing when it exceeds 64 bits.
std::optional<std::int64_t> AppendDigit(std::int64_t value, int digit) {
  if (value > (INT64_MAX - digit) / 10) return std::nullopt;
  return value * 10 + digit;
}

// The integer nearest to the decimal.
std::optional<std::int64_t> RoundToInteger(const Decimal& decimal) {
  const int num_digits = static_cast<int>(decimal.digits.size());
  const int num_integer_digits = num_digits == 0 ? 0 : num_digits + decimal.exponent;
  if (num_integer_digits > kMaxIntegerDigits) return std::nullopt;
  std::optional<std::int64_t> value = 0;
  for (int i = 0; i < num_integer_digits && value; ++i) {
    value =
        AppendDigit(*value, i < num_digits ? decimal.digits[static_cast<std::size_t>(i)] - '0' : 0);
  }
  if (!value) return std::nullopt;
  const bool round_up = num_integer_digits >= 0 && num_integer_digits < num_digits &&
                        decimal.digits[static_cast<std::size_t>(num_integer_digits)] >= '5';
  if (round_up && *value == INT64_MAX) return std::nullopt;
  const std::int64_t rounded = *value + (round_up ? 1 : 0);
  return decimal.negative ? -rounded : rounded;
}

std::optional<std::int64_t> ParseScaled(std::string_view text, int power_of_ten) {
  std::optional<Decimal> decimal = ParseDecimal(text);
  if (!decimal) return std::nullopt;
  decimal->exponent += power_of_ten;
  return RoundToInteger(*decimal);
}

}  // namespace

std::optional<std::int64_t> ParseSeconds(std::string_view text) { return ParseScaled(text, 9); }

std::optional<std::int64_t> ParseNanoseconds(std::string_view text) { return ParseScaled(text, 0); }

std::string FormatSeconds(std::int64_t timestamp_ns) {
  constexpr std::uint64_t kNanosecondsPerSecond = 1'000'000'000;
  const bool negative = timestamp_ns < 0;
  const auto bits = static_cast<std::uint64_t>(timestamp_ns);
  const std::uint64_t magnitude = negative ? 0 - bits : bits;
  return fmt::format("{}{}.{:09}", negative ? "-" : "", magnitude / kNanosecondsPerSecond,
                     magnitude % kNanosecondsPerSecond);
}

}  // namespace lift_slam
