#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "lift_slam/place_recognition/descriptor_file.h"
#include "lift_slam/place_recognition/vocabulary_tree.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct VocabularyTrainingOptions {
  int branching = 10;       // k; the paper's 10
  int depth = 5;            // L; the paper has 6
  int max_iterations = 11;  // of k-means; its cost hardly falls after
  // k-means sees at most so many rows of a node, evenly spread; all are assigned afterwards. Bounds
  // the memory to 100 MB of 128 floats, and the time of the upper levels.
  int max_rows_per_clustering = 200000;
  // A node with fewer rows stays a word: words of single descriptors recognise nothing.
  int min_rows_to_split = 10;
  int seed = 1;
  int num_threads = 1;  // the result does not depend on it

  void Visit(OptionVisitor& visitor);
  // Throws InputError naming the option that is out of range.
  void Check() const;
};

struct TrainingProgress {
  int level = 0;                                // that is being split; the root is 0
  std::uint64_t rows_done = 0, rows_total = 0;  // over all levels
};

// Returns false to stop.
using TrainingCallback = std::function<bool(const TrainingProgress&)>;

// Trains level by level. After each level the state goes to the file `checkpoint` (empty: none); a
// later call with the same input and options goes on from there, another one does not mind it.
// Memory: 4 bytes a descriptor, the centers, and one clustering's rows for each thread; descriptors
// stay on the disk. Nothing when stopped. Throws InputError when the file has too few descriptors:
// fewer than 10 for each child of the root, or from fewer than 2 images.
std::optional<VocabularyTree> TrainVocabulary(const DescriptorFile& file,
                                              const VocabularyTrainingOptions& options,
                                              const std::filesystem::path& checkpoint = {},
                                              const TrainingCallback& callback = {});

}  // namespace lift_slam
