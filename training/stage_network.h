#pragma once

#include "lift_slam/features/lift/lift_weights.h"
#include "training/training_options.h"

namespace lift_slam::training {

// Puts the network of one stage, and how its input is normalised, from one file's weights into
// another's.
void TakeNetwork(Stage stage, const LiftWeights& from, LiftWeights& to);

}  // namespace lift_slam::training
