#include "lift_slam/util/option_paths.h"

#include <algorithm>
#include <limits>

#include "lift_slam/util/nearest_name.h"

namespace lift_slam {
namespace {

class PathLister final : public OptionVisitor {
 public:
  explicit PathLister(OptionPaths& paths) : paths_(paths) {}

  void Field(std::string_view name, bool&, std::string_view) override { Add(name); }
  void Field(std::string_view name, int&, std::string_view) override { Add(name); }
  void Field(std::string_view name, double&, std::string_view) override { Add(name); }
  void Field(std::string_view name, std::string&, std::string_view) override { Add(name); }
  void Choice(std::string_view name, int&, std::span<const std::string_view>,
              std::string_view) override {
    Add(name);
  }

 protected:
  void BeginGroup(std::string_view name, std::string_view) override {
    paths_.groups.push_back(place_.Path(name));
    place_.Enter(name);
  }
  void EndGroup() override { place_.Leave(); }

 private:
  void Add(std::string_view name) { paths_.fields.push_back(place_.Path(name)); }

  OptionPaths& paths_;
  OptionPlace place_;
};

bool Contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string_view GroupOf(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

std::string_view NameOf(std::string_view path) { return path.substr(path.rfind('.') + 1); }

// A right name in another group is nearer than a name with two wrong characters in the same group.
int PathDistance(std::string_view a, std::string_view b) {
  return 2 * EditDistance(NameOf(a), NameOf(b)) + std::min(EditDistance(GroupOf(a), GroupOf(b)), 3);
}

}  // namespace

bool OptionPaths::IsField(std::string_view path) const { return Contains(fields, path); }

bool OptionPaths::IsGroup(std::string_view path) const { return Contains(groups, path); }

std::string OptionPaths::Nearest(std::string_view path) const {
  std::string nearest;
  int least = std::numeric_limits<int>::max();
  for (const auto* names : {&fields, &groups}) {
    for (const std::string& name : *names) {
      const int distance = PathDistance(path, name);
      if (distance < least) {
        least = distance;
        nearest = name;
      }
    }
  }
  return nearest;
}

OptionPaths ListOptionPaths(const OptionRoot& root) {
  OptionPaths paths;
  PathLister lister(paths);
  root(lister);
  return paths;
}

std::string OptionPlace::Path(std::string_view name) const {
  std::string path;
  for (const std::string& group : groups_) path += group + ".";
  return path.append(name);
}

}  // namespace lift_slam
