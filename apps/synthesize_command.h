#pragma once

namespace CLI {
class App;
}

namespace lift_slam {

// `lift_slam synthesize`: renders a sequence with exact ground truth in a dataset's layout.
void AddSynthesizeCommand(CLI::App& app);

}  // namespace lift_slam
