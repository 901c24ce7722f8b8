#include "lift_slam/datasets/keyed_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {

bool KeyedFile::HasGroup(const std::string& prefix) const {
  const auto next = entries_.lower_bound(prefix + "/");
  return next != entries_.end() && next->first.starts_with(prefix + "/");
}

std::vector<std::string> KeyedFile::Keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, entry] : entries_) keys.push_back(key);
  return keys;
}

const KeyedFile::Entry& KeyedFile::At(const std::string& key) const {
  const auto found = entries_.find(key);
  if (found == entries_.end()) {
    throw InputError(fmt::format("{}: the key '{}' is missing", source_, key));
  }
  return found->second;
}

void KeyedFile::Fail(const std::string& key, std::string_view expected) const {
  const Entry& entry = At(key);
  throw InputError(fmt::format("{}:{}: key '{}': expected {}, found '{}'", source_, entry.line, key,
                               expected, fmt::join(entry.values, ", ")));
}

std::string KeyedFile::Text(const std::string& key) const {
  const Entry& entry = At(key);
  if (entry.values.size() != 1) Fail(key, "one value");
  return entry.values.front();
}

std::vector<double> KeyedFile::Numbers(const std::string& key) const {
  std::vector<double> numbers;
  for (const std::string& text : At(key).values) {
    const std::optional<double> number = ParseDouble(text);
    if (!number || !std::isfinite(*number)) Fail(key, "finite numbers");
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<double> KeyedFile::Numbers(const std::string& key, std::size_t count) const {
  const std::vector<double> numbers = Numbers(key);
  if (numbers.size() != count) Fail(key, fmt::format("{} numbers", count));
  return numbers;
}

double KeyedFile::Number(const std::string& key) const { return Numbers(key, 1).front(); }

std::vector<int> KeyedFile::WholeNumbers(const std::string& key, std::size_t count) const {
  std::vector<int> whole;
  for (const double number : Numbers(key, count)) {
    if (number != std::floor(number) || std::abs(number) > std::numeric_limits<int>::max()) {
      Fail(key, count == 1 ? "a whole number" : "whole numbers");
    }
    whole.push_back(static_cast<int>(number));
  }
  return whole;
}

int KeyedFile::WholeNumber(const std::string& key) const { return WholeNumbers(key, 1).front(); }

bool KeyedFile::AllZero(const std::string& key) const {
  const std::vector<std::string>& values = At(key).values;
  return std::all_of(values.begin(), values.end(),
                     [](const std::string& text) { return ParseDouble(text) == 0.0; });
}

double KeyedFile::NumberOr(const std::string& key, double fallback) const {
  return Has(key) ? Number(key) : fallback;
}

int KeyedFile::WholeNumberOr(const std::string& key, int fallback) const {
  return Has(key) ? WholeNumber(key) : fallback;
}

}  // namespace lift_slam
