#pragma once

#include <filesystem>

#include "training/training_options.h"

namespace CLI {
class App;
}

namespace lift_slam::training {

// `lift_slam_train train STAGE ...`: trains one network of LIFT.
void AddTrainCommand(CLI::App& app);

// Trains with a progress bar until done, for `minutes` (0: no limit), or until SIGINT or SIGTERM:
// false then. The run in `output` goes on when it has a checkpoint and `resume` is set.
bool RunTraining(const TrainingOptions& options, const std::filesystem::path& output, bool resume,
                 double minutes);

}  // namespace lift_slam::training
