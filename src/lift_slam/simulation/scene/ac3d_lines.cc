#include "lift_slam/simulation/scene/ac3d_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::string_view kBlanks = " \t\r";

}  // namespace

Ac3dLines::Ac3dLines(std::string_view text, const std::filesystem::path& path)
    : text_(text), path_(path) {}

bool Ac3dLines::Next() {
  while (next_line_ < text_.size()) {
    const std::size_t end = std::min(text_.find('\n', next_line_), text_.size());
    rest_ = text_.substr(next_line_, end - next_line_);
    next_line_ = end + 1;
    ++line_number_;
    if (!AtEnd()) return true;
  }
  return false;
}

void Ac3dLines::Need(std::string_view what) {
  if (!Next()) Fail(fmt::format("the file ends where {} was expected", what));
}

void Ac3dLines::SkipBytes(std::size_t count) {
  const std::size_t end = std::min(next_line_ + count, text_.size());
  const std::string_view skipped = text_.substr(next_line_, end - next_line_);
  line_number_ += static_cast<int>(std::count(skipped.begin(), skipped.end(), '\n')) + 1;
  next_line_ = std::min(text_.find('\n', end), text_.size()) + 1;
}

bool Ac3dLines::AtEnd() {
  const std::size_t start = rest_.find_first_not_of(kBlanks);
  rest_ = start == std::string_view::npos ? std::string_view() : rest_.substr(start);
  return rest_.empty();
}

std::string_view Ac3dLines::Word() {
  if (AtEnd()) return {};
  const bool quoted = rest_.front() == '"';
  if (quoted) rest_.remove_prefix(1);
  const std::size_t end =
      std::min(quoted ? rest_.find('"') : rest_.find_first_of(kBlanks), rest_.size());
  const std::string_view word = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + (quoted ? 1 : 0), rest_.size()));
  return word;
}

float Ac3dLines::Float(std::string_view what) {
  const std::string_view word = Word();
  float value = 0.0F;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  const bool tiny = error == std::errc::result_out_of_range && word.find("e-") != word.npos;
  if (tiny) return 0.0F;
  if (word.empty() || error != std::errc() || end != word.data() + word.size() ||
      !std::isfinite(value)) {
    Fail(fmt::format("expected a number for {}, found '{}'", what, word));
  }
  return value;
}

int Ac3dLines::Count(std::string_view what) {
  const std::string_view word = Word();
  const bool hexadecimal = word.starts_with("0x") || word.starts_with("0X");
  const std::string_view digits = hexadecimal ? word.substr(2) : word;
  int value = 0;
  const auto [end, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), value, hexadecimal ? 16 : 10);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() || value < 0) {
    Fail(fmt::format("expected a count for {}, found '{}'", what, word));
  }
  return value;
}

void Ac3dLines::Fail(const std::string& what) const {
  throw InputError(fmt::format("{}:{}: {}", path_.string(), std::max(line_number_, 1), what));
}

}  // namespace lift_slam
