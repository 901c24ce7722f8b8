#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "lift_slam/features/descriptors.h"
#include "lift_slam/place_recognition/bag_of_words.h"
#include "lift_slam/place_recognition/vocabulary_tree.h"

namespace lift_slam {

// Writes the tree in the form that Vocabulary reads: bits as they are, floats as int8 with a scale
// for each center. The same bytes for the same tree. Throws InputError when the file cannot be
// written.
void WriteVocabulary(const VocabularyTree& tree, const std::filesystem::path& path);

struct VocabularyInfo {
  DescriptorKind kind;  // "orb", or the LIFT weights by their hash
  int branching = 0, depth = 0;
  std::uint32_t num_nodes = 0, num_words = 0;
  std::uint32_t num_images = 0;  // that it was trained from
  std::uint64_t num_rows = 0;    // descriptors of these
  std::uint64_t num_bytes = 0;   // of the file
  std::uint64_t checksum = 0;    // of the contents: the same vocabulary
  std::string description;       // what it was trained from, for people
};

// A feature's word and its node at the direct index's level.
struct WordPath {
  std::uint32_t word = 0, direct_node = 0;
};

// The words of an image.
struct ImageWords {
  BagOfWords bag;
  DirectIndex direct;
};

// A visual vocabulary (tf-idf tree), mapped from its file: loading reads the file once for its
// checksum and copies nothing. Safe for use by several threads at once.
class Vocabulary {
 public:
  // Throws InputError when the file is missing, foreign, of another version, truncated or damaged.
  explicit Vocabulary(const std::filesystem::path& path);
  ~Vocabulary();
  Vocabulary(Vocabulary&&) noexcept;
  Vocabulary& operator=(Vocabulary&&) noexcept;

  const VocabularyInfo& info() const { return info_; }
  // Throws InputError when descriptors of this kind have no words here: made by other weights, or
  // by another extractor.
  void CheckKind(const DescriptorKind& kind) const;

  // Level of the direct index: the one whose number of nodes is nearest to 100 (as a ratio),
  // whatever the depth; words above it count as nodes.
  int direct_level() const { return direct_level_; }
  // The nodes of that level, words above it included, in order.
  const std::vector<std::uint32_t>& direct_nodes() const { return direct_nodes_; }

  // The path of nearest nodes from the root to a word.
  WordPath Find(DescriptorView descriptor) const;
  // The descriptors must be of info().kind.
  ImageWords Transform(const Descriptors& descriptors) const;
  // ln(images / images with the word).
  float Idf(std::uint32_t word) const;
  // The center of a node as a descriptor (float values as they were rounded).
  Descriptors Centers(const std::vector<std::uint32_t>& nodes) const;

 private:
  struct File;

  std::vector<std::uint32_t> NodesAtLevel(int level) const;
  void ChooseDirectLevel();

  std::filesystem::path path_;
  VocabularyInfo info_;
  std::unique_ptr<File> file_;
  int direct_level_ = 0;
  std::vector<std::uint32_t> direct_nodes_;
};

}  // namespace lift_slam
