#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam evaluate`: a trajectory file against a reference file. The callback throws InputError.
void AddEvaluateCommand(CLI::App& app);

}  // namespace lift_slam
