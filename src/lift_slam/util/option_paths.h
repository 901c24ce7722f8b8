#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/util/option_root.h"

namespace lift_slam {

// The full names of all options, in the order of their structs.
struct OptionPaths {
  std::vector<std::string> fields;  // "matching.max_distance"
  std::vector<std::string> groups;  // "matching"

  bool IsField(std::string_view path) const;
  bool IsGroup(std::string_view path) const;
  // The field or group whose name is most like that of an unknown `path`; among equals one of the
  // same group. Empty when there are no options.
  std::string Nearest(std::string_view path) const;
};

OptionPaths ListOptionPaths(const OptionRoot& root);

// A visitor's place among the groups.
class OptionPlace {
 public:
  void Enter(std::string_view group) { groups_.emplace_back(group); }
  void Leave() { groups_.pop_back(); }
  std::size_t depth() const { return groups_.size(); }
  // "matching.max_distance" for the field "max_distance" of the group "matching".
  std::string Path(std::string_view name) const;

 private:
  std::vector<std::string> groups_;
};

}  // namespace lift_slam
