#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lift_slam/features/descriptors.h"

namespace lift_slam {

// A hierarchical k-means tree (Nister and Stewenius, 2006) as it comes from training. Node 0 is the
// root, whose center is zero; nodes are in order of level, and children of one node follow one
// another. A node without children is a leaf, which is a visual word.
struct VocabularyTree {
  DescriptorKind kind;
  int branching = 0;  // k: most children of a node
  int depth = 0;      // L: most levels below the root
  std::uint32_t num_images = 0;
  std::uint64_t num_rows = 0;
  Descriptors centers;                        // of each node
  std::vector<std::uint32_t> children_begin;  // num_nodes + 1: node i has [begin[i], begin[i + 1])
  std::vector<float> idf;                     // ln(images / images with the word); 0: inner node
  std::string description;                    // what it was trained from, for people

  std::size_t num_nodes() const { return idf.size(); }
};

}  // namespace lift_slam
