#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/place_recognition/vocabulary_tree.h"

namespace lift_slam {

// How far a training is, between two levels.
struct TrainingState {
  std::uint64_t level = 0;           // that is to be split next
  std::vector<std::uint32_t> order;  // rows of the descriptor file, grouped by node of the level
  // Rows of the level's nodes: node i has order[row_begin[i]] to order[row_begin[i + 1] - 1].
  std::vector<std::uint32_t> row_begin;
  // Of all nodes so far, as in VocabularyTree; children_begin and idf lack the level's nodes.
  Descriptors centers;
  std::vector<std::uint32_t> children_begin;
  std::vector<float> idf;
};

// `key` stands for the input and the options.
void WriteTrainingState(const TrainingState& state, const std::string& key,
                        const std::filesystem::path& path);

// Nothing when there is no such file, or it has another key or kind, or is damaged.
std::optional<TrainingState> ReadTrainingState(const std::filesystem::path& path,
                                               const std::string& key, const DescriptorKind& kind);

}  // namespace lift_slam
