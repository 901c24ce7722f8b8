#include "lift_slam/util/config_file.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <set>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_writer.h"

namespace lift_slam {
namespace {

// Far more than any configuration has; aliases could multiply without end.
constexpr std::size_t kMaxDepth = 16;
constexpr std::size_t kMaxSettings = 10000;

class SettingsCollector {
 public:
  explicit SettingsCollector(const std::string& name) : name_(name) {}

  // Adds everything below a map; `prefix` is its path and a dot, or empty.
  void AddMap(const YAML::Node& map, const std::string& prefix, std::size_t depth) {
    if (depth > kMaxDepth || settings_.size() > kMaxSettings) {
      throw InputError(
          fmt::format("{}: nested too deeply or too long for a configuration", Origin(map.Mark())));
    }
    for (const auto& entry : map) {
      if (!entry.first.IsScalar()) {
        throw InputError(
            fmt::format("{}: expected a name before the colon", Origin(entry.first.Mark())));
      }
      AddEntry(prefix + entry.first.Scalar(), entry.first.Mark(), entry.second, depth);
    }
  }

  std::vector<Setting> Take() { return std::move(settings_); }

 private:
  void AddEntry(const std::string& path, const YAML::Mark& mark, const YAML::Node& value,
                std::size_t depth) {
    if (!paths_.insert(path).second) {
      throw InputError(fmt::format("{}: option '{}' is given twice", Origin(mark), path));
    }
    if (value.IsSequence()) {
      throw InputError(
          fmt::format("{}: option '{}' is a list, expected one value", Origin(mark), path));
    }
    if (value.IsMap() && value.size() > 0) {
      AddMap(value, path + ".", depth + 1);
    } else {
      settings_.push_back({path, value.IsScalar() ? value.Scalar() : "", Origin(mark)});
    }
  }

  std::string Origin(const YAML::Mark& mark) const {
    return fmt::format("{}:{}", name_, mark.line + 1);
  }

  const std::string& name_;
  std::set<std::string> paths_;
  std::vector<Setting> settings_;
};

std::vector<YAML::Node> ParseYaml(const std::string& text, const std::string& name) {
  try {
    return YAML::LoadAll(text);
  } catch (const YAML::Exception& error) {
    throw InputError(
        fmt::format("{}:{}: not valid YAML: {}", name, error.mark.line + 1, error.msg));
  }
}

}  // namespace

void WriteConfigFile(const std::filesystem::path& path, std::string_view title,
                     const OptionRoot& root) {
  WriteTextAtomically(path, fmt::format("# {}\n\n{}", title, OptionsToYaml(root)));
}

std::vector<Setting> ReadConfigText(const std::string& text, const std::string& name) {
  const std::vector<YAML::Node> documents = ParseYaml(text, name);
  if (documents.empty() || (documents.size() == 1 && documents[0].IsNull())) return {};
  if (documents.size() > 1) {
    throw InputError(fmt::format("{}:{}: expected one YAML document, this is a second", name,
                                 documents[1].Mark().line + 1));
  }
  if (!documents[0].IsMap()) {
    throw InputError(
        fmt::format("{}:{}: expected 'key: value' lines", name, documents[0].Mark().line + 1));
  }
  SettingsCollector collector(name);
  collector.AddMap(documents[0], "", 1);
  return collector.Take();
}

std::vector<Setting> ReadConfigFile(const std::filesystem::path& path) {
  return ReadConfigText(ReadText(path), path.string());
}

void ConfigureOptions(const std::filesystem::path& config_file,
                      const std::vector<std::string>& overrides, const OptionRoot& root) {
  std::vector<Setting> settings;
  if (!config_file.empty()) settings = ReadConfigFile(config_file);
  for (const std::string& assignment : overrides) settings.push_back(ParseOverride(assignment));
  ApplySettings(settings, root);
}

}  // namespace lift_slam
