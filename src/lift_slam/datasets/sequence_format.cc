#include "lift_slam/datasets/sequence_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <filesystem>

#include "lift_slam/datasets/image_files.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> kFormatNames = {
    "kitti", "kitti_raw", "euroc", "tum_rgbd", "tum_mono", "images", "video", "live"};

bool IsCameraIndex(const std::string& source) {
  return !source.empty() && source.find_first_not_of("0123456789") == std::string::npos;
}

bool HasAnyFolder(const fs::path& folder, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return fs::is_directory(folder / name); });
}

std::optional<SequenceFormat> DetectFolder(const fs::path& folder) {
  if (HasAnyFolder(folder, {"mav0/cam0", "mav0/cam1", "cam0/data", "cam1/data"})) {
    return SequenceFormat::kEuroc;
  }
  if (fs::exists(folder / "rgb.txt")) return SequenceFormat::kTumRgbd;
  if (HasAnyFolder(folder, {"image_00/data", "image_01/data", "image_02/data", "image_03/data"})) {
    return SequenceFormat::kKittiRaw;
  }
  if (HasAnyFolder(folder, {"image_0", "image_1", "image_2", "image_3"})) {
    return SequenceFormat::kKittiOdometry;
  }
  const bool images = fs::is_directory(folder / "images") || fs::exists(folder / "images.zip");
  if (images && fs::exists(folder / "times.txt") && fs::exists(folder / "camera.txt")) {
    return SequenceFormat::kTumMono;
  }
  if (FindImageFolder(folder)) return SequenceFormat::kImageFolder;
  return std::nullopt;
}

std::vector<std::string> FolderReasons() {
  return {"EuRoC: no mav0/cam0",
          "TUM RGB-D: no rgb.txt",
          "KITTI raw: no image_00/data",
          "KITTI odometry: no image_0 or image_2",
          "TUM-mono: no images with times.txt and camera.txt",
          fmt::format("image folder: no image ({}) in it or in its folders {}",
                      fmt::join(ImageExtensions(), " "), fmt::join(ImageSubfolders(), ", "))};
}

FormatDetection DetectFile(const fs::path& file) {
  if (file.extension() == ".zip" || file.extension() == ".bag" || file.extension() == ".tar" ||
      file.extension() == ".gz") {
    return {std::nullopt, {"it is an archive: unpack it and give the folder"}};
  }
  if (IsImageFile(file)) return {std::nullopt, {"it is a single image: give the folder"}};
  return {SequenceFormat::kVideo, {}};
}

}  // namespace

std::string_view FormatName(SequenceFormat format) {
  return kFormatNames[static_cast<std::size_t>(format)];
}

SequenceFormat ParseFormatName(std::string_view name) {
  for (std::size_t i = 0; i < kFormatNames.size(); ++i) {
    if (kFormatNames[i] == name) return static_cast<SequenceFormat>(i);
  }
  throw InputError(fmt::format("there is no sequence format '{}'; the formats are {}", name,
                               fmt::join(kFormatNames, ", ")));
}

FormatDetection DetectFormat(const std::string& source) {
  if (source.find("://") != std::string::npos || source.starts_with("/dev/video")) {
    return {SequenceFormat::kLiveCamera, {}};
  }
  if (!fs::exists(source)) {
    if (IsCameraIndex(source)) return {SequenceFormat::kLiveCamera, {}};
    throw InputError(fmt::format("{}: no such file or folder", source));
  }
  if (!fs::is_directory(source)) return DetectFile(source);
  const std::optional<SequenceFormat> format = DetectFolder(source);
  return {format, format ? std::vector<std::string>() : FolderReasons()};
}

}  // namespace lift_slam
