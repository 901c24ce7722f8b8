#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam run`: a sequence to a trajectory, a map and a report. The callback throws InputError,
// and CLI::RuntimeError(kNoTrajectory) when the run gave no usable trajectory.
void AddRunCommand(CLI::App& app);

}  // namespace lift_slam
