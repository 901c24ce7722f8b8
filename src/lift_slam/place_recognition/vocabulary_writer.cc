#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <ostream>
#include <span>

#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/place_recognition/vocabulary_layout.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

// Pads to the alignment; returns where `bytes` begin.
std::uint64_t Append(std::span<const std::byte> bytes, std::vector<std::byte>& to) {
  to.resize((to.size() + kVocabularyAlignment - 1) / kVocabularyAlignment * kVocabularyAlignment);
  const std::uint64_t offset = to.size();
  to.insert(to.end(), bytes.begin(), bytes.end());
  return offset;
}

// Centers as the file has them, with the scales of floats.
struct PackedCenters {
  std::vector<std::byte> bytes;
  std::vector<float> scales;
};

void PackFloats(std::span<const float> values, PackedCenters& packed) {
  float largest = 0.0F;
  for (const float value : values) largest = std::max(largest, std::abs(value));
  const float scale = largest > 0.0F ? largest / static_cast<float>(kMaxQuantum) : 1.0F;
  packed.scales.push_back(scale);
  for (const float value : values) {
    const auto quantum = static_cast<std::int8_t>(std::lround(value / scale));
    packed.bytes.push_back(static_cast<std::byte>(quantum));
  }
}

PackedCenters Pack(const Descriptors& centers) {
  PackedCenters packed;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const DescriptorView row = centers.row(i);
    if (centers.kind().metric == DescriptorMetric::kHamming) {
      packed.bytes.insert(packed.bytes.end(), row.begin(), row.end());
    } else {
      PackFloats({reinterpret_cast<const float*>(row.data()), row.size() / sizeof(float)}, packed);
    }
  }
  return packed;
}

VocabularyHeader HeaderOf(const VocabularyTree& tree) {
  LIFT_SLAM_CHECK(tree.children_begin.size() == tree.num_nodes() + 1 &&
                      tree.centers.size() == tree.num_nodes() && tree.num_nodes() > 0,
                  "{} nodes, {} centers, {} first children", tree.num_nodes(), tree.centers.size(),
                  tree.children_begin.size());
  LIFT_SLAM_CHECK(tree.kind.dimension % 64 == 0, "descriptors of dimension {}",
                  tree.kind.dimension);
  VocabularyHeader header;
  header.metric = static_cast<std::uint32_t>(tree.kind.metric);
  header.dimension = static_cast<std::uint32_t>(tree.kind.dimension);
  header.branching = static_cast<std::uint32_t>(tree.branching);
  header.depth = static_cast<std::uint32_t>(tree.depth);
  header.num_nodes = static_cast<std::uint32_t>(tree.num_nodes());
  for (std::size_t i = 0; i < tree.num_nodes(); ++i) {
    header.num_words += tree.children_begin[i] == tree.children_begin[i + 1];
  }
  header.num_images = tree.num_images;
  header.num_rows = tree.num_rows;
  LIFT_SLAM_CHECK(tree.kind.name.size() <= header.kind_name.size(), "long name '{}'",
                  tree.kind.name);
  std::copy(tree.kind.name.begin(), tree.kind.name.end(), header.kind_name.begin());
  return header;
}

}  // namespace

void WriteVocabulary(const VocabularyTree& tree, const std::filesystem::path& path) {
  VocabularyHeader header = HeaderOf(tree);
  std::vector<std::byte> bytes(sizeof header);
  const PackedCenters centers = Pack(tree.centers);
  header.center_bytes = static_cast<std::uint32_t>(centers.bytes.size() / tree.num_nodes());
  Append(centers.bytes, bytes);
  if (!centers.scales.empty()) {
    header.scales_offset = Append(std::as_bytes(std::span(centers.scales)), bytes);
  }
  header.children_offset = Append(std::as_bytes(std::span(tree.children_begin)), bytes);
  header.idf_offset = Append(std::as_bytes(std::span(tree.idf)), bytes);
  header.description_offset = Append(std::as_bytes(std::span(tree.description)), bytes);
  header.num_bytes = bytes.size();
  const std::uint64_t of_sections = Checksum64(std::span(bytes).subspan(sizeof header));
  header.checksum =
      Checksum64(std::as_bytes(std::span(&header, 1)).first(offsetof(VocabularyHeader, checksum)),
                 of_sections);
  std::memcpy(bytes.data(), &header, sizeof header);
  WriteFileAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace lift_slam
