#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace lift_slam {

// Encodes image files as a video of a fixed rate, H.264 (.mp4, .mkv) or MPEG-4; all of one size,
// whose sides must be even. The file appears whole or not at all. `stop` (may be empty) ends it
// early without a file. Throws InputError for images that are missing or of another size, and when
// the codec or the file's ending is not known. Returns whether the file was written.
bool WriteVideo(const std::filesystem::path& path, const std::vector<std::filesystem::path>& images,
                double rate_hz, const std::function<bool()>& stop);

// Throws InputError unless both sides are even.
void CheckVideoSize(const std::filesystem::path& path, int width, int height);

}  // namespace lift_slam
