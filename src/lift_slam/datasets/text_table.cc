#include "lift_slam/datasets/text_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "lift_slam/geometry/timestamp_text.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

constexpr std::string_view kSeparators = " \t,";
constexpr double kMaxSizePx = 1e6;

std::vector<std::string> SplitFields(std::string_view line) {
  std::vector<std::string> fields;
  std::size_t begin = line.find_first_not_of(kSeparators);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(line.find_first_of(kSeparators, begin), line.size());
    fields.emplace_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kSeparators, end);
  }
  return fields;
}

// ParseIndex with a sign.
std::optional<std::int64_t> ParseWholeNumber(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const std::optional<std::int64_t> value = ParseIndex(text);
  return value && negative ? -*value : value;
}

}  // namespace

double TableRow::Number(std::size_t column) const {
  const auto value = column < size() ? ParseDouble(fields_[column]) : std::nullopt;
  if (!value) Fail(fmt::format("a number in column {}", column + 1));
  if (!std::isfinite(*value)) Fail(fmt::format("a finite number in column {}", column + 1));
  return *value;
}

std::int64_t TableRow::SecondsAsNs(std::size_t column) const {
  const auto value = column < size() ? ParseSeconds(fields_[column]) : std::nullopt;
  if (!value) Fail(fmt::format("a time in seconds in column {}", column + 1));
  return *value;
}

std::int64_t TableRow::Index(std::size_t column) const {
  const auto value = column < size() ? ParseWholeNumber(fields_[column]) : std::nullopt;
  if (!value) Fail(fmt::format("a whole number in column {}", column + 1));
  return *value;
}

int TableRow::SizePx(std::size_t column) const {
  const double size = Number(column);  // KITTI writes 1.392000e+03
  if (!(size >= 1.0 && size <= kMaxSizePx) || size != std::floor(size)) {
    Fail(fmt::format("an image size in whole pixels in column {}", column + 1));
  }
  return static_cast<int>(size);
}

std::vector<double> TableRow::Numbers(std::size_t first, std::size_t count) const {
  std::vector<double> values;
  for (std::size_t column = first; column < first + count; ++column) {
    values.push_back(Number(column));
  }
  return values;
}

void TableRow::Fail(std::string_view expected) const {
  std::string found = fmt::format("{}", fmt::join(fields_, " "));
  constexpr std::size_t kMaxShown = 80;
  if (found.size() > kMaxShown) found = found.substr(0, kMaxShown) + "...";
  throw InputError(fmt::format("{}:{}: expected {}, found '{}'", file_, line_, expected, found));
}

std::vector<TableRow> ReadTable(const std::filesystem::path& path, EmptyLines empty_lines) {
  std::vector<TableRow> rows;
  int number = 0, empty_line = 0;
  for (const std::string& line : ReadLines(path)) {
    ++number;
    std::vector<std::string> fields = SplitFields(line);
    if (fields.empty() && empty_line == 0) empty_line = number;
    if (fields.empty() || fields.front().front() == '#') continue;
    if (empty_line != 0 && empty_lines == EmptyLines::kRefuseBetweenRows) {
      throw InputError(fmt::format("{}:{}: empty line between rows; each line belongs to one image",
                                   path.string(), empty_line));
    }
    rows.emplace_back(path, number, std::move(fields));
  }
  return rows;
}

}  // namespace lift_slam
