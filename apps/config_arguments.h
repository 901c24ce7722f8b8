#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/program_options.h"

namespace CLI {
class App;
}

namespace lift_slam {

// The arguments --config FILE and --set key=value (repeatable) that several commands share.
struct ConfigArguments {
  std::filesystem::path config_file;   // empty: defaults only
  std::vector<std::string> overrides;  // "key=value"

  // Adds both to a command; *this must outlive it.
  void AddTo(CLI::App& command);
  // The defaults, changed by the file and then by the overrides. Throws InputError.
  ProgramOptions Read() const;
};

}  // namespace lift_slam
