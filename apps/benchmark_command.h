#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam benchmark`: systems on the sequences of a suite, several runs each, as tables.
void AddBenchmarkCommand(CLI::App& app);

}  // namespace lift_slam
