#include "lift_slam/util/option_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_paths.h"

namespace lift_slam {
namespace {

// The whole text as a number; nothing when it is none or out of the type's range.
template <class Number>
std::optional<Number> ParseNumber(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number number{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

// kCheck reads every value and throws for the first wrong one; kAssign also keeps them.
enum class Pass { kCheck, kAssign };

class SettingsApplier final : public OptionVisitor {
 public:
  SettingsApplier(const std::map<std::string, Setting>& settings, Pass pass)
      : settings_(settings), pass_(pass) {}

  void Field(std::string_view name, bool& value, std::string_view comment) override {
    Read(name, value, comment, "true or false", [](std::string_view text) -> std::optional<bool> {
      if (text == "true") return true;
      if (text == "false") return false;
      return std::nullopt;
    });
  }
  void Field(std::string_view name, int& value, std::string_view comment) override {
    const std::string expected =
        fmt::format("an integer from {} to {}", std::numeric_limits<int>::min(),
                    std::numeric_limits<int>::max());
    Read(name, value, comment, expected, ParseNumber<int>);
  }
  void Field(std::string_view name, double& value, std::string_view comment) override {
    Read(name, value, comment, "a finite number",
         [](std::string_view text) -> std::optional<double> {
           const std::optional<double> number = ParseNumber<double>(text);
           return number && std::isfinite(*number) ? number : std::nullopt;
         });
  }
  void Field(std::string_view name, std::string& value, std::string_view comment) override {
    Read(name, value, comment, "a text",
         [](std::string_view text) { return std::optional(std::string(text)); });
  }
  void Choice(std::string_view name, int& index, std::span<const std::string_view> names,
              std::string_view comment) override {
    const std::string expected = fmt::format("one of: {}", fmt::join(names, ", "));
    Read(name, index, comment, expected, [names](std::string_view text) -> std::optional<int> {
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == text) return static_cast<int>(i);
      }
      return std::nullopt;
    });
  }

 protected:
  void BeginGroup(std::string_view name, std::string_view) override { place_.Enter(name); }
  void EndGroup() override { place_.Leave(); }

 private:
  template <class Value, class Parse>
  void Read(std::string_view name, Value& value, std::string_view comment,
            std::string_view expected, const Parse& parse) {
    const auto found = settings_.find(place_.Path(name));
    if (found == settings_.end()) return;
    const Setting& setting = found->second;
    const std::optional<Value> parsed = parse(setting.value);
    if (!parsed) {
      throw InputError(fmt::format("{}: option '{}' is '{}', expected {}{}", setting.origin,
                                   setting.path, setting.value, expected,
                                   comment.empty() ? "" : fmt::format(" ({})", comment)));
    }
    if (pass_ == Pass::kAssign) value = *parsed;
  }

  const std::map<std::string, Setting>& settings_;
  const Pass pass_;
  OptionPlace place_;
};

void CheckKnown(const Setting& setting, const OptionPaths& paths) {
  if (paths.IsField(setting.path)) return;
  if (paths.IsGroup(setting.path)) {
    if (setting.value.empty()) return;  // a group whose options are all left out
    throw InputError(fmt::format("{}: option '{}' is a group of options, expected no value",
                                 setting.origin, setting.path));
  }
  const std::string nearest = paths.Nearest(setting.path);
  throw InputError(
      fmt::format("{}: unknown option '{}'{}", setting.origin, setting.path,
                  nearest.empty() ? "" : fmt::format("; the nearest known is '{}'", nearest)));
}

}  // namespace

Setting ParseOverride(std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    throw InputError(
        fmt::format("--set '{}': expected key=value, for example "
                    "'group.option=1.5'",
                    assignment));
  }
  return {std::string(assignment.substr(0, equals)), std::string(assignment.substr(equals + 1)),
          "--set"};
}

void ApplySettings(std::span<const Setting> settings, const OptionRoot& root) {
  const OptionPaths paths = ListOptionPaths(root);
  std::map<std::string, Setting> by_path;
  for (const Setting& setting : settings) {
    CheckKnown(setting, paths);
    by_path.insert_or_assign(setting.path, setting);
  }
  for (const Pass pass : {Pass::kCheck, Pass::kAssign}) {
    SettingsApplier applier(by_path, pass);
    root(applier);
  }
}

}  // namespace lift_slam
