#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "lift_slam/place_recognition/descriptor_file.h"

namespace lift_slam {

// The bytes of a descriptor file; little-endian, as are all CPUs the project runs on.
struct DescriptorFileHeader {
  static constexpr std::array<char, 8> kMagic = {'L', 'S', 'D', 'E', 'S', 'C', '\n', '\x1a'};
  static constexpr std::uint32_t kVersion = 1;

  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kVersion;
  std::uint32_t metric = 0;     // DescriptorMetric
  std::uint32_t dimension = 0;  // bits or floats
  std::uint32_t reserved = 0;
  std::array<char, 64> source_sha256 = {};
  std::array<char, 160> kind_name = {};  // padded with zeros
  std::uint64_t checksum = 0;            // of all before
};
static_assert(sizeof(DescriptorFileHeader) == 256);

// At the start of a record, padded with zeros to the length of a row.
struct ImageRecordHeader {
  static constexpr std::uint32_t kMagic = 0x47414d49;  // "IMAG"

  std::uint32_t magic = kMagic;
  std::uint32_t num_rows = 0;
  std::uint64_t checksum = 0;  // of the rows
};

DescriptorFileHeader MakeHeader(const DescriptorFileSource& source);
// Throws InputError, naming `path`, for what is no such header.
DescriptorFileSource ParseHeader(std::span<const std::byte> bytes,
                                 const std::filesystem::path& path);

enum class RecordState { kComplete, kCutOff, kDamaged };
struct ImageRecord {
  RecordState state = RecordState::kCutOff;
  std::size_t num_rows = 0, num_bytes = 0;  // of a complete record
};

// The record at the begin of `bytes`, which go to the end of the file.
ImageRecord ParseRecord(std::span<const std::byte> bytes, std::size_t stride);

}  // namespace lift_slam
