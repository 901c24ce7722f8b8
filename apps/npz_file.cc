#include "apps/npz_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <functional>
#include <numeric>
#include <ostream>

#include "lift_slam/util/check.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

// As zip archives want it (polynomial 0xEDB88320, reflected).
std::uint32_t Crc32(const std::string& bytes) {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    table[i] = i;
    for (int bit = 0; bit < 8; ++bit) {
      table[i] = (table[i] & 1U) != 0 ? 0xEDB88320U ^ (table[i] >> 1) : table[i] >> 1;
    }
  }
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : bytes)
    crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (crc >> 8);
  return crc ^ 0xFFFFFFFFU;
}

template <class... Numbers>
std::string LittleEndian(Numbers... numbers) {
  std::string bytes;
  const auto append = [&](auto number) {
    for (std::size_t i = 0; i < sizeof number; ++i) {
      bytes += static_cast<char>(static_cast<std::uint64_t>(number) >> (8 * i) & 0xFFU);
    }
  };
  (append(numbers), ...);
  return bytes;
}

// The header of a .npy file, version 1.0, padded to a multiple of 64.
std::string NpyHeader(const char* type, const std::vector<std::size_t>& shape) {
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}",
                                 type, fmt::join(shape, ", "));
  constexpr std::size_t kPrefix = 10;
  text.append(63 - (kPrefix + text.size()) % 64, ' ');
  text += '\n';
  return std::string("\x93NUMPY\x01\x00", 8) +
         LittleEndian(static_cast<std::uint16_t>(text.size())) + text;
}

std::string NpyContents(const std::vector<std::size_t>& shape, const char* type,
                        std::span<const std::byte> bytes) {
  const std::size_t count =
      std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  LIFT_SLAM_CHECK(4 * count == bytes.size() && bytes.size() < 0x70000000U,
                  "an array has {} bytes for {} values", bytes.size(), count);
  std::string contents = NpyHeader(type, shape);
  contents.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  return contents;
}

// What the header of a file and the directory at the end have in common: version 2.0, no flags,
// stored, 1 January 1980, checksum, both sizes, length of the name, nothing extra.
std::string Properties(const std::string& name, const std::string& contents) {
  constexpr std::uint16_t kVersion = 20, kFlags = 0, kStored = 0, kTime = 0, kDate = 33, kExtra = 0;
  const auto size = static_cast<std::uint32_t>(contents.size());
  return LittleEndian(kVersion, kFlags, kStored, kTime, kDate, Crc32(contents), size, size,
                      static_cast<std::uint16_t>(name.size()), kExtra);
}

}  // namespace

void WriteNpy(const std::filesystem::path& path, const std::vector<std::size_t>& shape,
              std::span<const float> values) {
  WriteTextAtomically(path, NpyContents(shape, "<f4", std::as_bytes(values)));
}

void NpzFile::Add(const std::string& name, const std::vector<std::size_t>& shape,
                  std::span<const float> values) {
  AddBytes(name, shape, "<f4", std::as_bytes(values));
}

void NpzFile::Add(const std::string& name, const std::vector<std::size_t>& shape,
                  std::span<const std::int32_t> values) {
  AddBytes(name, shape, "<i4", std::as_bytes(values));
}

void NpzFile::AddBytes(const std::string& name, const std::vector<std::size_t>& shape,
                       const char* type, std::span<const std::byte> bytes) {
  entries_.push_back({name + ".npy", NpyContents(shape, type, bytes)});
}

void NpzFile::Write(const std::filesystem::path& path) const {
  std::string archive, directory;
  for (const Entry& entry : entries_) {
    const std::string properties = Properties(entry.name, entry.contents);
    constexpr std::uint16_t kMadeBy = 20, kNone = 0;
    const auto offset = static_cast<std::uint32_t>(archive.size());
    archive += "PK\x03\x04" + properties + entry.name + entry.contents;
    directory += "PK\x01\x02" + LittleEndian(kMadeBy) + properties +
                 LittleEndian(kNone, kNone, kNone, std::uint32_t{0}, offset) + entry.name;
  }
  const auto count = static_cast<std::uint16_t>(entries_.size());
  const std::string end =
      "PK\x05\x06" + LittleEndian(std::uint32_t{0}, count, count,
                                  static_cast<std::uint32_t>(directory.size()),
                                  static_cast<std::uint32_t>(archive.size()), std::uint16_t{0});
  WriteTextAtomically(path, archive + directory + end);
}

}  // namespace lift_slam
