#pragma once

#include <filesystem>

#include "apps/program_options.h"
#include "apps/run_log.h"
#include "lift_slam/datasets/sequence.h"

namespace lift_slam {

// Runs SLAM over a sequence with progress on stderr, each online pose written to the folder as it
// comes, and refusals in the log. Ends early, with everything so far, on SIGINT or SIGTERM.
RunRecord RunSlam(std::unique_ptr<Sequence> sequence, const ProgramOptions& options,
                  const std::filesystem::path& folder, RunLog& log);

}  // namespace lift_slam
