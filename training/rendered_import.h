#pragma once

#include <filesystem>

#include "lift_slam/util/options.h"
#include "training/photograph_import.h"
#include "training/training_set_writer.h"

namespace lift_slam::training {

struct RenderedOptions {
  double min_sigma = 1.2;              // of keypoints
  int max_keypoints = 2000;            // of a frame, the strongest
  int max_points = 250;                // of a reference frame, a random choice
  int max_partners = 6;                // frames that a reference frame is related to
  double max_depth_difference = 0.02;  // a share: more is taken for an occlusion
  int max_empty_places = 40;           // of a frame
  int seed = 1;
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

// Adds a sequence that `lift_slam render --depth --pairs` wrote. A point is a SIFT keypoint of one
// frame that, carried over by depth and poses, is visible and a SIFT keypoint of others too: views
// that are right to a pixel or two, with the noise that keypoints have. All images are of one
// scene. `scene` is its name; `licence` and `author` are those of the model drawn. Throws
// InputError when the folder lacks depth, poses or pairs.
void ImportRendered(const std::filesystem::path& folder, const ImageOrigin& origin,
                    const RenderedOptions& options, const ImportProgress& progress,
                    TrainingSetWriter& writer);

}  // namespace lift_slam::training
