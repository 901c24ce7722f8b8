#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/image/image.h"

namespace lift_slam {

// Every `step`-th image of each source, in natural order: images, or folders with all that lies
// below them, but for hidden ones and folders named depth*; links that lead to no file are left out
// with a warning. Throws InputError for what is neither, and when there is no image.
std::vector<std::filesystem::path> CollectImages(const std::vector<std::filesystem::path>& sources,
                                                 int step);

// A grey image, shrunk so that its longer side has at most max_side_px (0: as it is). Nothing when
// it cannot be read, with one sentence in `why`.
std::optional<GrayImage> ReadImageOfSide(const std::filesystem::path& file, int max_side_px,
                                         std::string* why);

}  // namespace lift_slam
