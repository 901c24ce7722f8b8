#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lift_slam/features/descriptors.h"
#include "lift_slam/loop_closing/loop_closing_options.h"
#include "lift_slam/place_recognition/vocabulary.h"

namespace lift_slam {

// The vocabulary of a run, or none and why.
struct VocabularyChoice {
  std::shared_ptr<const Vocabulary> vocabulary;
  std::string notice;  // why places are not recognised; empty with a vocabulary
};

// The file that the options name; else the one made for these descriptors among the shipped
// (*.vocabulary in the folder of the environment variable LIFT_SLAM_VOCABULARY_DIR, else in
// vocabularies/, see ShippedFile). Throws InputError for a file that was named, or a folder given
// by the variable, and does not fit.
VocabularyChoice ChooseVocabulary(const LoopClosingOptions& options, const DescriptorKind& kind);

// The files that ChooseVocabulary takes one of, whatever the descriptors; none when loop closing is
// off. Throws InputError for a folder given by the variable that is none.
std::vector<std::filesystem::path> VocabularyFiles(const LoopClosingOptions& options);

}  // namespace lift_slam
