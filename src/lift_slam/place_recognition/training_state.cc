#include "lift_slam/place_recognition/training_state.h"

#include <cstring>
#include <ostream>
#include <span>

#include "lift_slam/util/checksum64.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/mapped_file.h"

namespace lift_slam {
namespace {

// Sections, each with its size in bytes and its checksum before it.
void WriteSection(std::ostream& stream, std::span<const std::byte> bytes) {
  const std::uint64_t header[2] = {bytes.size(), Checksum64(bytes)};
  stream.write(reinterpret_cast<const char*>(header), sizeof header);
  stream.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

// The next section; nothing when the file ends early or is damaged.
std::optional<std::span<const std::byte>> ReadSection(std::span<const std::byte>& bytes) {
  std::uint64_t header[2];
  if (bytes.size() < sizeof header) return std::nullopt;
  std::memcpy(header, bytes.data(), sizeof header);
  bytes = bytes.subspan(sizeof header);
  if (header[0] > bytes.size()) return std::nullopt;
  const auto section = bytes.first(header[0]);
  bytes = bytes.subspan(header[0]);
  if (Checksum64(section) != header[1]) return std::nullopt;
  return section;
}

template <class T>
bool Read(std::span<const std::byte>& bytes, std::vector<T>& values) {
  const auto section = ReadSection(bytes);
  if (!section || section->size() % sizeof(T) != 0) return false;
  values.resize(section->size() / sizeof(T));
  if (!values.empty()) std::memcpy(values.data(), section->data(), section->size());
  return true;
}

bool Read(std::span<const std::byte>& bytes, Descriptors& rows) {
  const auto section = ReadSection(bytes);
  const std::size_t stride = rows.kind().BytesPerRow();
  if (!section || section->size() % stride != 0) return false;
  rows = Descriptors(rows.kind(), section->size() / stride);
  if (!section->empty()) std::memcpy(rows.mutable_data(), section->data(), section->size());
  return true;
}

}  // namespace

void WriteTrainingState(const TrainingState& state, const std::string& key,
                        const std::filesystem::path& path) {
  WriteFileAtomically(path, [&](std::ostream& stream) {
    const std::span rows(state.centers.data(),
                         state.centers.size() * state.centers.kind().BytesPerRow());
    WriteSection(stream, std::as_bytes(std::span(key)));
    WriteSection(stream, std::as_bytes(std::span(&state.level, 1)));
    WriteSection(stream, std::as_bytes(std::span(state.order)));
    WriteSection(stream, std::as_bytes(std::span(state.row_begin)));
    WriteSection(stream, rows);
    WriteSection(stream, std::as_bytes(std::span(state.children_begin)));
    WriteSection(stream, std::as_bytes(std::span(state.idf)));
  });
}

std::optional<TrainingState> ReadTrainingState(const std::filesystem::path& path,
                                               const std::string& key, const DescriptorKind& kind) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return std::nullopt;
  const MappedFile file(path);
  std::span<const std::byte> bytes = file.bytes();
  TrainingState state;
  state.centers = Descriptors(kind, 0);
  std::vector<char> found_key;
  std::vector<std::uint64_t> level;
  if (!Read(bytes, found_key) || std::string(found_key.begin(), found_key.end()) != key) {
    return std::nullopt;
  }
  const bool is_whole = Read(bytes, level) && level.size() == 1 && Read(bytes, state.order) &&
                        Read(bytes, state.row_begin) && Read(bytes, state.centers) &&
                        Read(bytes, state.children_begin) && Read(bytes, state.idf);
  if (!is_whole) return std::nullopt;
  state.level = level[0];
  return state;
}

}  // namespace lift_slam
