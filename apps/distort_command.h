#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam distort`: the conditions of the robustness experiments as images and as a figure.
void AddDistortCommand(CLI::App& app);

}  // namespace lift_slam
