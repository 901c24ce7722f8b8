#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam weights import FILE.h5... --output FILE.safetensors`: weights that the authors of LIFT
// released, in our format; `lift_slam weights info FILE`: what a file of weights holds.
void AddWeightsCommand(CLI::App& app);

}  // namespace lift_slam
