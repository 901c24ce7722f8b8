#pragma once

namespace CLI {
class App;
}

namespace lift_slam::training {

// `lift_slam_train prepare KIND ...`: training sets from photographs and rendered sequences.
void AddPrepareCommand(CLI::App& app);

}  // namespace lift_slam::training
