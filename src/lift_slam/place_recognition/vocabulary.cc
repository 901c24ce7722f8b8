#include "lift_slam/place_recognition/vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>

#include "lift_slam/place_recognition/file_header.h"
#include "lift_slam/place_recognition/vocabulary_layout.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/mapped_file.h"

namespace lift_slam {
namespace {

constexpr double kWantedDirectNodes = 100.0;

std::string KindName(const VocabularyHeader& header) {
  return {header.kind_name.begin(),
          std::find(header.kind_name.begin(), header.kind_name.end(), '\0')};
}

// Empty, or what is wrong with the file's begin.
std::string HeaderFault(std::span<const std::byte> bytes, VocabularyHeader& header) {
  header = ReadHeader<VocabularyHeader>(bytes);
  if (bytes.size() < header.magic.size() || header.magic != VocabularyHeader::kMagic) {
    return "is no vocabulary of lift_slam";
  }
  if (bytes.size() < sizeof header) return "is truncated (within its header)";
  if (header.version != VocabularyHeader::kVersion) {
    return fmt::format("has version {}, this program reads version {}: build the vocabulary anew",
                       header.version, VocabularyHeader::kVersion);
  }
  if (bytes.size() < header.num_bytes) {
    return fmt::format("is truncated: {} of {} bytes", bytes.size(), header.num_bytes);
  }
  return {};
}

// So that sums of an offset and a section's size cannot overflow.
bool OffsetsAreInFile(const VocabularyHeader& header) {
  return std::max({header.scales_offset, header.children_offset, header.idf_offset,
                   header.description_offset}) <= header.num_bytes;
}

// What a checksum cannot tell: whether a writer meant well.
bool IsConsistent(const VocabularyHeader& header) {
  const std::uint64_t nodes = header.num_nodes;
  const bool is_binary = header.metric == static_cast<std::uint32_t>(DescriptorMetric::kHamming);
  const std::uint64_t center_bytes = is_binary ? header.dimension / 8 : header.dimension;
  const std::uint64_t centers_end = sizeof header + nodes * center_bytes;
  return OffsetsAreInFile(header) && header.metric <= 1 && nodes > 0 && header.dimension > 0 &&
         header.dimension % 64 == 0 && header.center_bytes == center_bytes && header.depth <= 64 &&
         centers_end <= (is_binary ? header.children_offset : header.scales_offset) &&
         (is_binary ? header.scales_offset == 0
                    : header.children_offset >= header.scales_offset + 4 * nodes) &&
         header.idf_offset >= header.children_offset + 4 * (nodes + 1) &&
         header.description_offset >= header.idf_offset + 4 * nodes &&
         header.num_bytes >= header.description_offset && header.children_offset % 4 == 0 &&
         header.idf_offset % 4 == 0 && header.scales_offset % 4 == 0;
}

bool AreFinite(std::span<const float> values) {
  return std::ranges::all_of(values, [](float value) { return std::isfinite(value); });
}

// Children come after their parent, in order, and are all there: no path is endless.
bool IsTree(std::span<const std::uint32_t> children_begin, std::uint32_t num_nodes) {
  for (std::uint32_t i = 0; i < num_nodes; ++i) {
    if (children_begin[i] <= i || children_begin[i] > children_begin[i + 1]) return false;
  }
  return children_begin[num_nodes] == num_nodes;
}

struct Center {
  const std::byte* bytes;
  float scale;  // of floats
};

int DistanceOfBits(DescriptorView descriptor, const Center& center) {
  int bits = 0;
  for (std::size_t i = 0; i < descriptor.size(); i += 8) {
    std::uint64_t a, b;
    std::memcpy(&a, descriptor.data() + i, 8);
    std::memcpy(&b, center.bytes + i, 8);
    bits += std::popcount(a ^ b);
  }
  return bits;
}

// Squared; summed in lanes, which the compiler turns into vector instructions.
float DistanceOfFloats(DescriptorView descriptor, const Center& center) {
  constexpr std::size_t kLanes = 16;
  const auto* values = reinterpret_cast<const float*>(descriptor.data());
  const auto* quanta = reinterpret_cast<const std::int8_t*>(center.bytes);
  float lanes[kLanes] = {};
  for (std::size_t i = 0; i < descriptor.size() / sizeof(float); i += kLanes) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float difference = values[i + k] - center.scale * static_cast<float>(quanta[i + k]);
      lanes[k] += difference * difference;
    }
  }
  float sum = 0.0F;
  for (const float lane : lanes) sum += lane;
  return sum;
}

}  // namespace

struct Vocabulary::File {
  explicit File(const std::filesystem::path& path) : mapped(path) {
    const std::span<const std::byte> bytes = mapped.bytes();
    std::string fault = HeaderFault(bytes, header);
    if (fault.empty()) fault = ContentsFault(bytes);
    if (!fault.empty()) throw InputError(fmt::format("{}: {}", path.string(), fault));
  }

  std::string ContentsFault(std::span<const std::byte> bytes) {
    const std::uint64_t of_sections = Checksum64(bytes.subspan(sizeof header));
    if (bytes.size() != header.num_bytes ||
        header.checksum !=
            Checksum64(bytes.first(offsetof(VocabularyHeader, checksum)), of_sections)) {
      return "is damaged, or changed after it was written (checksum)";
    }
    if (!IsConsistent(header)) return "is no vocabulary of this program (its sections overlap)";
    centers = bytes.data() + sizeof header;
    children_begin = {reinterpret_cast<const std::uint32_t*>(bytes.data() + header.children_offset),
                      std::size_t{header.num_nodes} + 1};
    if (header.scales_offset > 0) {
      scales = reinterpret_cast<const float*>(bytes.data() + header.scales_offset);
    }
    idf = {reinterpret_cast<const float*>(bytes.data() + header.idf_offset), header.num_nodes};
    if (!IsTree(children_begin, header.num_nodes))
      return "is no vocabulary (its nodes are no tree)";
    if (!AreFinite(idf) || (scales != nullptr && !AreFinite({scales, header.num_nodes}))) {
      return "is no vocabulary (a weight or scale of it is not finite)";
    }
    return {};
  }

  template <class Distance>
  WordPath Find(DescriptorView descriptor, int direct_level, Distance distance_to) const {
    WordPath path;
    for (int level = 0;; ++level) {
      if (level <= direct_level) path.direct_node = path.word;
      const std::uint32_t begin = children_begin[path.word], end = children_begin[path.word + 1];
      if (begin == end) return path;
      auto least = distance_to(descriptor, CenterOf(begin));
      path.word = begin;
      for (std::uint32_t child = begin + 1; child < end; ++child) {
        const auto distance = distance_to(descriptor, CenterOf(child));
        if (!(distance < least)) continue;
        least = distance;
        path.word = child;
      }
    }
  }

  Center CenterOf(std::uint32_t node) const {
    return {centers + std::size_t{node} * header.center_bytes,
            scales == nullptr ? 1.0F : scales[node]};
  }

  MappedFile mapped;
  VocabularyHeader header;
  const std::byte* centers = nullptr;
  const float* scales = nullptr;  // of floats
  std::span<const std::uint32_t> children_begin;
  std::span<const float> idf;
};

Vocabulary::Vocabulary(const std::filesystem::path& path)
    : path_(path), file_(std::make_unique<File>(path)) {
  const VocabularyHeader& header = file_->header;
  info_.kind = {KindName(header), static_cast<DescriptorMetric>(header.metric),
                static_cast<int>(header.dimension)};
  info_.branching = static_cast<int>(header.branching);
  info_.depth = static_cast<int>(header.depth);
  info_.num_nodes = header.num_nodes;
  info_.num_words = header.num_words;
  info_.num_images = header.num_images;
  info_.num_rows = header.num_rows;
  info_.num_bytes = header.num_bytes;
  info_.checksum = header.checksum;
  const auto text = file_->mapped.bytes().subspan(header.description_offset);
  info_.description.assign(reinterpret_cast<const char*>(text.data()), text.size());
  ChooseDirectLevel();
}

Vocabulary::~Vocabulary() = default;
Vocabulary::Vocabulary(Vocabulary&&) noexcept = default;
Vocabulary& Vocabulary::operator=(Vocabulary&&) noexcept = default;

void Vocabulary::CheckKind(const DescriptorKind& kind) const {
  if (kind == info_.kind) return;
  throw InputError(fmt::format("{}: is a vocabulary for descriptors '{}', not for '{}'",
                               path_.string(), info_.kind.name, kind.name));
}

std::vector<std::uint32_t> Vocabulary::NodesAtLevel(int level) const {
  std::vector<std::uint32_t> nodes = {0};
  for (int i = 0; i < level; ++i) {
    std::vector<std::uint32_t> next;
    for (const std::uint32_t node : nodes) {
      const std::uint32_t begin = file_->children_begin[node],
                          end = file_->children_begin[node + 1];
      if (begin == end) next.push_back(node);
      for (std::uint32_t child = begin; child < end; ++child) next.push_back(child);
    }
    nodes = std::move(next);
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

void Vocabulary::ChooseDirectLevel() {
  double best = std::numeric_limits<double>::infinity();
  for (int level = 1; level <= std::max(1, info_.depth); ++level) {
    std::vector<std::uint32_t> nodes = NodesAtLevel(level);
    const auto count = static_cast<double>(nodes.size());
    const double difference = std::abs(std::log(count / kWantedDirectNodes));
    if (difference < best) {
      best = difference;
      direct_level_ = level;
      direct_nodes_ = std::move(nodes);
    }
    if (count > kWantedDirectNodes) break;
  }
}

WordPath Vocabulary::Find(DescriptorView descriptor) const {
  if (info_.kind.metric == DescriptorMetric::kHamming) {
    return file_->Find(descriptor, direct_level_, DistanceOfBits);
  }
  return file_->Find(descriptor, direct_level_, DistanceOfFloats);
}

ImageWords Vocabulary::Transform(const Descriptors& descriptors) const {
  LIFT_SLAM_CHECK(descriptors.size() == 0 || descriptors.kind() == info_.kind,
                  "descriptors '{}' for a vocabulary of '{}'", descriptors.kind().name,
                  info_.kind.name);
  std::vector<WordWeight> weights(descriptors.size());
  std::vector<std::uint32_t> direct_nodes(descriptors.size());
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const WordPath path = Find(descriptors.row(i));
    weights[i] = {path.word, Idf(path.word)};
    direct_nodes[i] = path.direct_node;
  }
  return {BagOfWords::FromWeights(std::move(weights)), DirectIndex::FromNodes(direct_nodes)};
}

float Vocabulary::Idf(std::uint32_t word) const { return file_->idf[word]; }

Descriptors Vocabulary::Centers(const std::vector<std::uint32_t>& nodes) const {
  Descriptors rows(info_.kind, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Center center = file_->CenterOf(nodes[i]);
    if (info_.kind.metric == DescriptorMetric::kHamming) {
      std::memcpy(rows.mutable_row(i).data(), center.bytes, file_->header.center_bytes);
      continue;
    }
    auto* values = reinterpret_cast<float*>(rows.mutable_row(i).data());
    for (std::uint32_t k = 0; k < file_->header.dimension; ++k) {
      values[k] =
          center.scale * static_cast<float>(reinterpret_cast<const std::int8_t*>(center.bytes)[k]);
    }
  }
  return rows;
}

}  // namespace lift_slam
