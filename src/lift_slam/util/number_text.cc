#include "lift_slam/util/number_text.h"

#include <charconv>

namespace lift_slam {

std::optional<std::int64_t> ParseIndex(std::string_view text) {
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
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
