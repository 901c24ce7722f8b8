#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lift_slam {

enum class SequenceFormat {
  kKittiOdometry,
  kKittiRaw,
  kEuroc,
  kTumRgbd,
  kTumMono,
  kImageFolder,
  kVideo,
  kLiveCamera,
};

// "kitti", "kitti_raw", "euroc", "tum_rgbd", "tum_mono", "images", "video", "live".
std::string_view FormatName(SequenceFormat format);
// Throws InputError that lists the names when there is no such one.
SequenceFormat ParseFormatName(std::string_view name);

struct FormatDetection {
  std::optional<SequenceFormat> format;
  // When nothing fits: for each layout what was looked for.
  std::vector<std::string> reasons;
};

// What a path, camera index or URL is, from the names of its files alone. Throws InputError when
// there is no such file or folder.
FormatDetection DetectFormat(const std::string& source);

}  // namespace lift_slam
