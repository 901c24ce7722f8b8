#pragma once

namespace CLI {
class App;
}

namespace lift_slam::training {

// `lift_slam_train assemble` puts networks of several runs into one file; `lift_slam_train
// calibrate` measures its distances of descriptors and ranges of activations.
void AddWeightsCommands(CLI::App& app);

}  // namespace lift_slam::training
