#pragma once

#include <string>

#include "lift_slam/util/option_root.h"

namespace lift_slam {

// The present values of all options as YAML, each under its comment. Reading it back
// (ReadConfigText in util/config_file.h) gives exactly the same values.
std::string OptionsToYaml(const OptionRoot& root);

}  // namespace lift_slam
