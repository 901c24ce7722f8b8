#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam config [--config FILE] [--set key=value]...`: prints all options with their comments
// as YAML, changed by the file and the overrides when given.
void AddConfigCommand(CLI::App& app);

}  // namespace lift_slam
