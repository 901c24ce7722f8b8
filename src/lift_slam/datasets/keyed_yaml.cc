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

// Far more than any calibration has, the points of all its images included; aliases could nest
// and multiply without end.
constexpr int kMaxDepth = 16;
constexpr int kMaxNodes = 100'000;

}  // namespace

class YamlFlattener {
 public:
  explicit YamlFlattener(KeyedFile& file) : file_(file) {}

  void Flatten(const std::string& key, const YAML::Node& node, int depth = 1) {
    CheckLimits(node, depth);
    if (node.IsMap()) {
      for (const auto& item : node) {
        const std::string name = item.first.IsScalar() ? item.first.Scalar() : "?";
        Flatten(key.empty() ? name : key + "/" + name, item.second, depth + 1);
      }
      return;
    }
    KeyedFile::Entry& entry = file_.entries_[key];
    if (entry.line == 0) entry.line = node.Mark().line + 1;
    if (node.IsScalar()) entry.values.push_back(node.Scalar());
    for (std::size_t i = 0; node.IsSequence() && i < node.size(); ++i) {
      Flatten(key, node[i], depth + 1);
    }
  }

 private:
  void CheckLimits(const YAML::Node& node, int depth) {
    if (depth <= kMaxDepth && ++num_nodes_ <= kMaxNodes) return;
    throw InputError(fmt::format(
        "{}:{}: nested too deeply or too long for a calibration (at most {} levels and {} values)",
        file_.source_, node.Mark().line + 1, kMaxDepth, kMaxNodes));
  }

  KeyedFile& file_;
  int num_nodes_ = 0;
};

KeyedFile KeyedFile::ReadYaml(const std::filesystem::path& path) {
  KeyedFile file;
  file.source_ = path.string();
  try {
    std::vector<YAML::Node> documents = YAML::LoadAll(WithoutOpenCvHeader(ReadText(path)));
    std::erase_if(documents, [](const YAML::Node& document) { return document.IsNull(); });
    if (documents.empty() || !documents[0].IsMap()) {
      throw InputError(fmt::format("{}: expected YAML with 'key: value' lines", path.string()));
    }
    if (documents.size() > 1) {
      throw InputError(fmt::format("{}:{}: expected one YAML document, this is a second",
                                   path.string(), documents[1].Mark().line + 1));
    }
    YamlFlattener(file).Flatten("", documents[0]);
  } catch (const YAML::Exception& error) {
    throw InputError(
        fmt::format("{}:{}: no valid YAML: {}", path.string(), error.mark.line + 1, error.msg));
  }
  return file;
}

}  // namespace lift_slam
