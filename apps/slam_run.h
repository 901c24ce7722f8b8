#pragma once

#include <filesystem>
#include <vector>

#include "apps/program_options.h"
#include "apps/run_log.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/image/image_distortion.h"

namespace lift_slam {

// Runs SLAM over a sequence with progress on stderr, each online pose written to the folder as it
// comes, and refusals in the log. Every image goes through the distortions first. Ends early, with
// everything so far, on SIGINT or SIGTERM.
RunRecord RunSlam(std::unique_ptr<Sequence> sequence, const ProgramOptions& options,
                  const std::filesystem::path& folder, RunLog& log,
                  const std::vector<ImageDistortion>& distortions = {});

}  // namespace lift_slam
