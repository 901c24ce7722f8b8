#include "apps/config_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "apps/config_arguments.h"
#include "lift_slam/util/option_writer.h"

namespace lift_slam {

void AddConfigCommand(CLI::App& app) {
  const auto arguments = std::make_shared<ConfigArguments>();
  CLI::App* command = app.add_subcommand("config", "Print all options with their comments as YAML");
  arguments->AddTo(*command);
  command->footer(
      "Examples:\n"
      "  lift_slam config > my.yaml           all options with their defaults\n"
      "  lift_slam config --config my.yaml    check a file, and see what it comes to\n"
      "  lift_slam config --set seed=7        the defaults with one option changed");
  command->callback([arguments] {
    ProgramOptions options = arguments->Read();
    std::cout << OptionsToYaml(MakeOptionRoot(options));
  });
}

}  // namespace lift_slam
