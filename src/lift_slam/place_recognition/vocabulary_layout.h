#pragma once

#include <array>
#include <cstdint>

namespace lift_slam {

// The begin of a vocabulary's file; little-endian. Sections follow, each at a multiple of 64 bytes:
// centers (num_nodes rows), scale of each center (floats only: values are its int8 times the scale,
// so that the short vectors near the root are as exact as the leaves), first child of each node
// (num_nodes + 1), idf of each node, description.
struct VocabularyHeader {
  static constexpr std::array<char, 8> kMagic = {'L', 'S', 'V', 'O', 'C', 'A', '\n', '\x1a'};
  static constexpr std::uint32_t kVersion = 1;

  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t metric = 0;     // DescriptorMetric
  std::uint32_t dimension = 0;  // bits or floats
  std::uint32_t branching = 0, depth = 0;
  std::uint32_t num_nodes = 0, num_words = 0;
  std::uint32_t num_images = 0;
  std::uint64_t num_rows = 0;
  std::uint32_t center_bytes = 0;  // of one row: bits, or an int8 for each float
  std::uint32_t reserved0 = 0;
  std::uint64_t scales_offset = 0;  // of floats; 0 for bits
  std::uint64_t children_offset = 0, idf_offset = 0, description_offset = 0;
  std::uint64_t num_bytes = 0;           // of the file
  std::array<char, 160> kind_name = {};  // padded with zeros
  std::array<char, 56> reserved = {};
  std::uint64_t checksum = 0;  // of all bytes after the header and of the header before this
};
static_assert(sizeof(VocabularyHeader) == 320);

inline constexpr std::uint64_t kVocabularyAlignment = 64;
inline constexpr int kMaxQuantum = 127;  // int8 values are symmetric

}  // namespace lift_slam
