#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/util/option_settings.h"

namespace lift_slam {

// All options and their present values (OptionsToYaml) to a file that appears whole or not at all;
// `title` is its first line, a comment. Throws InputError when it cannot be written.
void WriteConfigFile(const std::filesystem::path& path, std::string_view title,
                     const OptionRoot& root);

// The settings of a YAML file of nested groups. Throws InputError, naming file and line, when it is
// missing, is no YAML, holds a key twice or a list. A key without a value gives an empty one.
// Whether the options exist is up to ApplySettings.
std::vector<Setting> ReadConfigFile(const std::filesystem::path& path);
// The same from a text; `name` stands for the file in messages.
std::vector<Setting> ReadConfigText(const std::string& text, const std::string& name);

// What a program does with its command line: the file (when the path is not empty), then the
// --set overrides, which win. Throws InputError as the functions it calls.
void ConfigureOptions(const std::filesystem::path& config_file,
                      const std::vector<std::string>& overrides, const OptionRoot& root);

}  // namespace lift_slam
