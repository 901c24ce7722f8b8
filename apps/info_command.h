#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam info`: versions of the program and its libraries, and what the machine offers.
void AddInfoCommand(CLI::App& app);

}  // namespace lift_slam
