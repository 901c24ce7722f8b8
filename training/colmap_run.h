#pragma once

#include <filesystem>
#include <string>

#include "lift_slam/util/options.h"
#include "training/colmap_import.h"

namespace lift_slam::training {

struct ReconstructionOptions {
  int step = 1;             // every so many frames of the sequence
  int max_frames = 0;       // 0: all
  int max_features = 4000;  // SIFT keypoints of an image
  int overlap = 10;         // following images that an image is matched with
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

// Reconstructs a sequence (any that lift_slam runs on) by COLMAP's structure from motion, on the
// CPU and without a screen. `work` keeps the images, the database, the models, colmap.log and, in
// `source`, what it is a reconstruction of; what is there already is used again. Returns the
// largest model. Throws InputError when COLMAP is missing, fails, or finds no model, and when
// `work` holds the reconstruction of another sequence or one with other options.
ColmapPaths ReconstructSequence(const std::string& sequence, const std::filesystem::path& work,
                                const ReconstructionOptions& options);

}  // namespace lift_slam::training
