#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam weights calibrate` and `weights distances`: what a file of weights says of itself,
// measured on photographs and written to a new file.
void AddMeasureWeightsCommands(CLI::App& weights);

}  // namespace lift_slam
