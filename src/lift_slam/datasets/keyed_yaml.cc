#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "lift_slam/datasets/keyed_file.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// OpenCV writes "%YAML:1.0", which is no YAML directive; as a comment it keeps the line numbers.
std::string WithoutOpenCvHeader(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with("%YAML")) text.front() = '#';
  return text;
}

}  // namespace

class YamlFlattener {
 public:
  explicit YamlFlattener(KeyedFile& file) : file_(file) {}

  void Flatten(const std::string& key, const YAML::Node& node) {
    if (node.IsMap()) {
      for (const auto& item : node) {
        const std::string name = item.first.IsScalar() ? item.first.Scalar() : "?";
        Flatten(key.empty() ? name : key + "/" + name, item.second);
      }
      return;
    }
    KeyedFile::Entry& entry = file_.entries_[key];
    if (entry.line == 0) entry.line = node.Mark().line + 1;
    if (node.IsScalar()) entry.values.push_back(node.Scalar());
    for (std::size_t i = 0; node.IsSequence() && i < node.size(); ++i) Flatten(key, node[i]);
  }

 private:
  KeyedFile& file_;
};

KeyedFile KeyedFile::ReadYaml(const std::filesystem::path& path) {
  KeyedFile file;
  file.source_ = path.string();
  try {
    const YAML::Node root = YAML::Load(WithoutOpenCvHeader(ReadText(path)));
    if (!root.IsMap()) {
      throw InputError(fmt::format("{}: expected YAML with 'key: value' lines", path.string()));
    }
    YamlFlattener(file).Flatten("", root);
  } catch (const YAML::Exception& error) {
    throw InputError(
        fmt::format("{}:{}: no valid YAML: {}", path.string(), error.mark.line + 1, error.msg));
  }
  return file;
}

}  // namespace lift_slam
