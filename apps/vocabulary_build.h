#pragma once

#include <filesystem>
#include <vector>

#include "apps/feature_arguments.h"
#include "lift_slam/place_recognition/vocabulary_trainer.h"

namespace lift_slam {

struct VocabularyBuildArguments {
  std::vector<std::filesystem::path> sources;
  std::filesystem::path output;
  std::filesystem::path descriptors;  // file of them; empty: output + ".descriptors", removed after
  int step = 1;
  int max_side_px = 1280;
  FeatureArguments features;
  VocabularyTrainingOptions training;
};

// `lift_slam vocabulary build`: features of the images to a file on disk, then training from there.
// Stopped by a signal, the same command goes on.
void BuildVocabulary(const VocabularyBuildArguments& arguments);

}  // namespace lift_slam
