#include "apps/config_arguments.h"

#include <CLI/CLI.hpp>

#include "lift_slam/util/config_file.h"

namespace lift_slam {

void ConfigArguments::AddTo(CLI::App& command) {
  command.add_option("--config", config_file, "YAML file of options that differ from the defaults")
      ->type_name("FILE");
  command
      .add_option("--set", overrides,
                  "One option, over the file; may be repeated ('lift_slam config' lists all)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);  // each --set takes one word
}

ProgramOptions ConfigArguments::Read() const {
  ProgramOptions options;
  ConfigureOptions(config_file, overrides, MakeOptionRoot(options));
  return options;
}

}  // namespace lift_slam
