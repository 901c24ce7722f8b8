#pragma once

#include <string_view>

#include "apps/run_outputs.h"
#include "lift_slam/evaluation/evaluation_options.h"
#include "lift_slam/slam/pipeline.h"
#include "lift_slam/slam/slam_options.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

inline constexpr std::string_view kRunModeNames[] = {"sequential", "threaded"};

// All options of the program: what `lift_slam config` prints, --config reads and --set changes.
struct ProgramOptions {
  int seed = 0;  // of everything random; the same seed gives the same result
  // Both modes give the same trajectory to the bit; threaded is faster.
  RunMode mode = RunMode::kThreaded;
  SlamOptions slam;
  EvaluationOptions evaluation;
  RunOutputOptions outputs;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("seed", seed, "of everything random; the same seed gives the same result");
    visitor.Field("mode", mode, kRunModeNames,
                  "sequential: one thread; threaded: reading and extraction run ahead");
    visitor.Group("slam", slam, "from image to map");
    visitor.Group("evaluation", evaluation, "errors against ground truth");
    visitor.Group("outputs", outputs, "files of a run");
  }
};

}  // namespace lift_slam
