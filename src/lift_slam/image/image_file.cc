#include "lift_slam/image/image_file.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace lift_slam {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', 0x0D, 0x0A, 0x1A, 0x0A};
constexpr std::array<std::uint8_t, 3> kJpegSignature = {0xFF, 0xD8, 0xFF};

bool StartsWith(Bytes file, Bytes signature) {
  return file.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), file.begin());
}

// Chunks of 4 bytes length, 4 bytes type, data, 4 bytes checksum; the last is IEND.
bool HasPngEnd(Bytes file) {
  std::size_t at = kPngSignature.size();
  while (at + 12 <= file.size()) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | file[at + i];
    const std::string_view type(reinterpret_cast<const char*>(&file[at + 4]), 4);
    if (type == "IEND") return true;
    at += 12 + length;
  }
  return false;
}

// The place of the next marker at or after `at`: 0xFF and a byte that is neither stuffing (0x00),
// a restart marker, nor fill (0xFF). The file's size when there is none.
std::size_t NextJpegMarker(Bytes file, std::size_t at) {
  for (; at + 1 < file.size(); ++at) {
    const std::uint8_t code = file[at + 1];
    const bool is_restart = code >= 0xD0 && code <= 0xD7;
    if (file[at] == 0xFF && code != 0x00 && code != 0xFF && !is_restart) return at;
  }
  return file.size();
}

// Segments of marker, 2 bytes length, data; coded data follows a start of scan up to the next
// marker. Segments are skipped whole: an embedded thumbnail has an end marker of its own.
bool HasJpegEnd(Bytes file) {
  for (std::size_t at = NextJpegMarker(file, 2); at + 1 < file.size();) {
    constexpr std::uint8_t kEndOfImage = 0xD9;
    if (file[at + 1] == kEndOfImage) return true;
    if (at + 3 >= file.size()) return false;
    const std::size_t length = std::size_t{file[at + 2]} << 8 | file[at + 3];
    at = NextJpegMarker(file, at + 2 + length);
  }
  return false;
}

}  // namespace

bool IsCompleteImageFile(Bytes file) {
  if (StartsWith(file, kPngSignature)) return HasPngEnd(file);
  if (StartsWith(file, kJpegSignature)) return HasJpegEnd(file);
  return true;
}

}  // namespace lift_slam
