#include "lift_slam/place_recognition/descriptor_file_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "lift_slam/place_recognition/file_header.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr int kMaxDimension = 1 << 16;

std::uint64_t ChecksumOf(const DescriptorFileHeader& header) {
  return Checksum64(
      std::as_bytes(std::span(&header, 1)).first(offsetof(DescriptorFileHeader, checksum)));
}

template <std::size_t kSize>
void CopyText(const std::string& text, std::array<char, kSize>& to) {
  LIFT_SLAM_CHECK(text.size() <= kSize, "'{}' has more than {} characters", text, kSize);
  std::copy(text.begin(), text.end(), to.begin());
}

template <std::size_t kSize>
std::string Text(const std::array<char, kSize>& from) {
  return {from.begin(), std::find(from.begin(), from.end(), '\0')};
}

// Empty, or what is wrong.
std::string Fault(const DescriptorFileHeader& header) {
  if (header.version != DescriptorFileHeader::kVersion) {
    return fmt::format("has version {}, this program reads version {}", header.version,
                       DescriptorFileHeader::kVersion);
  }
  if (header.checksum != ChecksumOf(header)) return "is damaged (checksum of its header)";
  const DescriptorKind kind{"", static_cast<DescriptorMetric>(header.metric),
                            static_cast<int>(header.dimension)};
  if (header.metric > 1 || header.dimension < 1 || header.dimension > kMaxDimension ||
      kind.BytesPerRow() < sizeof(ImageRecordHeader) || kind.BytesPerRow() % 8 != 0) {
    return "describes descriptors of no known kind";
  }
  return {};
}

}  // namespace

DescriptorFileHeader MakeHeader(const DescriptorFileSource& source) {
  LIFT_SLAM_CHECK(source.kind.BytesPerRow() >= sizeof(ImageRecordHeader), "rows of {} bytes",
                  source.kind.BytesPerRow());
  DescriptorFileHeader header;
  header.metric = static_cast<std::uint32_t>(source.kind.metric);
  header.dimension = static_cast<std::uint32_t>(source.kind.dimension);
  CopyText(source.sha256, header.source_sha256);
  CopyText(source.kind.name, header.kind_name);
  header.checksum = ChecksumOf(header);
  return header;
}

DescriptorFileSource ParseHeader(std::span<const std::byte> bytes,
                                 const std::filesystem::path& path) {
  const auto header = ReadHeader<DescriptorFileHeader>(bytes);
  const bool is_whole = bytes.size() >= sizeof header;
  if (bytes.size() < header.magic.size() || header.magic != DescriptorFileHeader::kMagic) {
    throw InputError(fmt::format("{}: is no file of descriptors", path.string()));
  }
  const std::string fault = is_whole ? Fault(header) : "is truncated (within its header)";
  if (!fault.empty()) throw InputError(fmt::format("{}: {}", path.string(), fault));
  return {{Text(header.kind_name), static_cast<DescriptorMetric>(header.metric),
           static_cast<int>(header.dimension)},
          Text(header.source_sha256)};
}

ImageRecord ParseRecord(std::span<const std::byte> bytes, std::size_t stride) {
  if (bytes.size() < stride) return {};
  ImageRecordHeader header;
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != ImageRecordHeader::kMagic) return {RecordState::kDamaged};
  const std::size_t num_bytes = (std::size_t{header.num_rows} + 1) * stride;
  if (bytes.size() < num_bytes) return {};
  const auto rows = bytes.subspan(stride, num_bytes - stride);
  if (Checksum64(rows) != header.checksum) return {RecordState::kDamaged};
  return {RecordState::kComplete, header.num_rows, num_bytes};
}

}  // namespace lift_slam
