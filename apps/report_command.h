#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam report`: the results of many runs as tables. The callback throws InputError.
void AddReportCommand(CLI::App& app);

}  // namespace lift_slam
