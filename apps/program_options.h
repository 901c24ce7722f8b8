#pragma once

#include "lift_slam/util/options.h"

namespace lift_slam {

// All options of the program: what `lift_slam config` prints, --config reads and --set changes.
struct ProgramOptions {
  int seed = 0;  // of everything random; the same seed gives the same result

  void Visit(OptionVisitor& visitor) {
    visitor.Field("seed", seed,
                  "of everything random; the same seed gives the same result in sequential mode");
  }
};

}  // namespace lift_slam
