#pragma once

#include <memory>

#include "lift_slam/map/frame.h"
#include "lift_slam/place_recognition/descriptor_file.h"
#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/place_recognition/vocabulary_trainer.h"
#include "lift_slam/testing/temporary_folder.h"

namespace lift_slam {

// A small vocabulary trained from the descriptors of some frames.
inline std::shared_ptr<const Vocabulary> VocabularyOf(const std::vector<Frame>& frames) {
  const TemporaryFolder folder;
  const auto rows = folder / "rows";
  {
    DescriptorFileWriter writer(rows, {frames.front().features->descriptor_kind(), "test"});
    for (const Frame& frame : frames) writer.AddImage(frame.features->descriptors());
  }
  VocabularyTrainingOptions options;
  options.branching = 8;
  options.depth = 3;
  options.min_rows_to_split = 4;
  const auto path = folder / "test.vocabulary";
  WriteVocabulary(*TrainVocabulary(DescriptorFile(rows), options), path);
  return std::make_shared<Vocabulary>(path);  // stays mapped when the file is gone
}

}  // namespace lift_slam
