#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/util/option_root.h"

namespace lift_slam {

// One value given from outside for one option.
struct Setting {
  std::string path;    // "matching.max_distance": groups and field, joined by dots
  std::string value;   // as written
  std::string origin;  // for messages: "configs/kitti.yaml:12" or "--set"
};

// Splits "key.sub=value" of the command line; throws InputError when there is no key or no '='.
Setting ParseOverride(std::string_view assignment);

// Gives the options the values of the settings; a later setting of one option replaces an earlier
// one. Nothing is changed unless all settings are right. Throws InputError, naming origin and key,
// for an unknown option (with the nearest known one), a group given a value, and a value of the
// wrong type (with the expected type and range). NaN and infinities are refused.
void ApplySettings(std::span<const Setting> settings, const OptionRoot& root);

}  // namespace lift_slam
