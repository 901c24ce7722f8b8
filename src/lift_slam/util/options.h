#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lift_slam {

// How option structs show themselves to whoever reads, prints or checks them.
// An option struct has `void Visit(OptionVisitor&)` that names each field once:
//
//   void Visit(OptionVisitor& visitor) {
//     visitor.Field("max_features", max_features, "features per image; 0: by resolution");
//     visitor.Group("matching", matching);   // a struct with its own Visit
//   }
//
// The struct's initialisers are the only defaults.
class OptionVisitor {
 public:
  virtual ~OptionVisitor() = default;

  virtual void Field(std::string_view name, bool& value, std::string_view comment) = 0;
  virtual void Field(std::string_view name, int& value, std::string_view comment) = 0;
  virtual void Field(std::string_view name, double& value, std::string_view comment) = 0;
  virtual void Field(std::string_view name, std::string& value, std::string_view comment) = 0;
  // A choice: `index` is the position in `names`.
  virtual void Choice(std::string_view name, int& index, std::span<const std::string_view> names,
                      std::string_view comment) = 0;

  // An enum class whose values count from 0 in the order of `names`.
  template <class Enum>
  requires std::is_enum_v<Enum>
  void Field(std::string_view name, Enum& value, std::span<const std::string_view> names,
             std::string_view comment) {
    int index = static_cast<int>(value);
    Choice(name, index, names, comment);
    value = static_cast<Enum>(index);
  }

  template <class Options>
  void Group(std::string_view name, Options& options, std::string_view comment = {}) {
    BeginGroup(name, comment);
    options.Visit(*this);
    EndGroup();
  }

 protected:
  virtual void BeginGroup(std::string_view name, std::string_view comment) = 0;
  virtual void EndGroup() = 0;
};

}  // namespace lift_slam
