#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/image/image.h"

namespace lift_slam {

// Lower case, with the dot. Matching ignores case.
const std::vector<std::string>& ImageExtensions();
bool IsImageFile(const std::filesystem::path& file);

// The images right in a folder in natural order (frame2 before frame10); hidden files are left
// out. Throws InputError when the folder is missing or holds none.
std::vector<std::filesystem::path> ListImages(const std::filesystem::path& folder);

// Where a plain image folder's images lie: the folder itself or the first of ImageSubfolders that
// holds one. Nothing when there is none.
std::optional<std::filesystem::path> FindImageFolder(const std::filesystem::path& folder);
const std::vector<std::string>& ImageSubfolders();

// Digit runs compare as numbers, all else by byte.
bool NaturalLess(const std::string& a, const std::string& b);

// The number a file is named by ("000012.png" is 12); nothing when its stem is no number.
std::optional<std::int64_t> ImageNumber(const std::filesystem::path& file);

// Like ReadGrayImage, but also refuses a JPEG file that ends early, which the decoder would fill
// up with grey.
std::optional<GrayImage> ReadWholeImage(const std::filesystem::path& file, std::string* why);

// Whether JPEG data reaches its end marker; true for data that is no JPEG.
bool IsWholeJpeg(const std::string& data);

}  // namespace lift_slam
