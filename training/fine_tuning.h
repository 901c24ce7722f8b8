#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/features/lift/lift_weights.h"
#include "training/training_options.h"

namespace lift_slam::training {

// What the training of several networks came to.
struct TunedWeights {
  std::optional<LiftWeights> weights;  // nothing: it was ended before there were any
  bool is_complete = false;            // all steps were made
};

// Trains the networks named by `stages` one after the other, each for `minutes` (0: no limit) in
// the folder of `output` named after it, where a run that is there goes on. Of each run's best
// weights only its own network takes its place in those of `options.from`, and the next begins with
// all of them, in after-STAGE.safetensors: the others in its file may be older. A run that has had
// another descriptor before it is told of on standard error. The weights hold no distances and
// ranges.
TunedWeights TrainInTurn(const std::vector<std::string>& stages, TrainingOptions options,
                         const std::filesystem::path& output, double minutes);

}  // namespace lift_slam::training
