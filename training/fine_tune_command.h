#pragma once

namespace CLI {
class App;
}

namespace lift_slam::training {

// `lift_slam_train fine-tune --from WEIGHTS --data SET`: goes on training weights on one's own
// images.
void AddFineTuneCommand(CLI::App& app);

}  // namespace lift_slam::training
