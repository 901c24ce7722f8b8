#include "apps/vocabulary_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "lift_slam/datasets/image_files.h"
#include "lift_slam/image/resize.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

// Each folder once, by whatever links: they may lead in a circle.
void AddFolder(const fs::path& folder, std::set<fs::path>& visited, std::vector<fs::path>& images) {
  if (!visited.insert(fs::canonical(folder)).second) return;
  std::vector<fs::path> files, folders;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.')) continue;
    std::error_code error;
    if (entry.is_directory(error)) {
      if (!name.starts_with("depth")) folders.push_back(entry.path());
    } else if (IsImageFile(entry.path())) {
      if (entry.is_regular_file(error)) {
        files.push_back(entry.path());
      } else {
        std::cerr << fmt::format("warning: {}: left out: {}\n", entry.path().string(),
                                 error ? error.message() : "is no file");
      }
    }
  }
  const auto by_name = [](const fs::path& a, const fs::path& b) {
    return NaturalLess(a.filename().string(), b.filename().string());
  };
  std::sort(files.begin(), files.end(), by_name);
  std::sort(folders.begin(), folders.end(), by_name);
  images.insert(images.end(), files.begin(), files.end());
  for (const fs::path& below : folders) AddFolder(below, visited, images);
}

std::vector<fs::path> ImagesOf(const fs::path& source) {
  std::vector<fs::path> images;
  if (fs::is_directory(source)) {
    std::set<fs::path> visited;
    AddFolder(source, visited, images);
    if (images.empty()) throw InputError(source.string() + ": holds no images");
  } else if (!fs::exists(source)) {
    throw InputError(source.string() + ": no such file or folder");
  } else if (!IsImageFile(source) || !fs::is_regular_file(source)) {
    throw InputError(source.string() + ": is no image, expected one or a folder of them");
  } else {
    images.push_back(source);
  }
  return images;
}

// By halves first, each the mean of 2 x 2 pixels, so that nothing is skipped.
GrayImage Shrink(GrayImage image, int max_side_px) {
  while (std::max(image.width(), image.height()) >= 2 * max_side_px) {
    image = Resize(image, image.width() / 2, image.height() / 2);
  }
  const double ratio = static_cast<double>(max_side_px) / std::max(image.width(), image.height());
  if (ratio >= 1.0) return image;
  const auto scaled = [&](int side) {
    return std::max(1, static_cast<int>(std::lround(ratio * side)));
  };
  return Resize(image, scaled(image.width()), scaled(image.height()));
}

}  // namespace

std::vector<fs::path> CollectImages(const std::vector<fs::path>& sources, int step) {
  std::vector<fs::path> images;
  for (const fs::path& source : sources) {
    const std::vector<fs::path> all = ImagesOf(source);
    for (std::size_t i = 0; i < all.size(); i += static_cast<std::size_t>(step)) {
      images.push_back(all[i]);
    }
  }
  if (images.empty()) throw InputError("no images were named");
  return images;
}

std::optional<GrayImage> ReadImageOfSide(const fs::path& file, int max_side_px, std::string* why) {
  std::optional<GrayImage> image = ReadWholeImage(file, why);
  if (image && max_side_px > 0) image = Shrink(*image, max_side_px);
  return image;
}

}  // namespace lift_slam
