#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/program_options.h"
#include "apps/run_log.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/image/image_distortion.h"

namespace lift_slam {

// Maps kept from run to run.
struct MapFiles {
  std::filesystem::path load, save;  // empty: none
  bool localization_only = false;    // in the loaded maps

  // Throws InputError for arguments that contradict one another, or a file whose folder is missing.
  void Check() const;
};

// What a run keeps in files besides its results.
struct RunFiles {
  MapFiles maps;
  std::filesystem::path feature_cache;  // folder; empty: none
};

struct SlamRun {
  RunRecord record;
  std::string save_error;  // why the maps could not be saved; empty: they were, or need not be
};

// Runs SLAM over a sequence with progress on stderr, each online pose written to the folder as it
// comes, and refusals in the log. Every image goes through the distortions first. Ends early, with
// everything so far, on SIGINT or SIGTERM. Maps that cannot be saved do not take the rest along.
SlamRun RunSlam(std::unique_ptr<Sequence> sequence, const ProgramOptions& options,
                const std::filesystem::path& folder, const RunFiles& files, RunLog& log,
                const std::vector<ImageDistortion>& distortions = {});

}  // namespace lift_slam
