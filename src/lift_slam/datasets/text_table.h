#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lift_slam {

// One line of a text file, split at blanks, tabs and commas. Remembers where it stands, so that
// every complaint names the file and the line.
class TableRow {
 public:
  TableRow(const std::filesystem::path& file, int line, std::vector<std::string> fields)
      : file_(file.string()), line_(line), fields_(std::move(fields)) {}

  const std::vector<std::string>& fields() const { return fields_; }
  std::size_t size() const { return fields_.size(); }
  const std::string& operator[](std::size_t column) const { return fields_[column]; }
  int line() const { return line_; }

  // These throw InputError when the field is missing or no such value; numbers must be finite.
  double Number(std::size_t column) const;
  std::int64_t SecondsAsNs(std::size_t column) const;
  // Digits with or without a sign; a fraction or an exponent is refused, not rounded.
  std::int64_t Index(std::size_t column) const;
  // A width or height, 1 to 1e6 whole pixels, in any notation.
  int SizePx(std::size_t column) const;
  // Columns first to first + count - 1.
  std::vector<double> Numbers(std::size_t first, std::size_t count) const;

  // Throws InputError "<file>:<line>: expected <expected>, found '<the line>'".
  [[noreturn]] void Fail(std::string_view expected) const;

 private:
  std::string file_;
  int line_;
  std::vector<std::string> fields_;
};

enum class EmptyLines {
  kSkip,
  kRefuseBetweenRows,  // where a line is an image: one left out would shift all that follow
};

// All lines but empty ones and comments ('#' first).
// Throws InputError when the file cannot be read or has an empty line that is refused.
std::vector<TableRow> ReadTable(const std::filesystem::path& path,
                                EmptyLines empty_lines = EmptyLines::kSkip);

}  // namespace lift_slam
