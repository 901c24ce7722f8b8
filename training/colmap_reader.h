#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lift_slam::training {

// A keypoint of a COLMAP model that belongs to a 3-D point.
struct ColmapObservation {
  std::size_t keypoint = 0;  // index among the image's keypoints
  std::uint64_t point = 0;   // id of the 3-D point
};

// An image of a COLMAP model, as far as training needs it.
struct ColmapImage {
  std::uint32_t id = 0;
  std::string name;  // file, relative to the image folder
  std::vector<ColmapObservation> observations;
};

// images.bin or images.txt of a sparse model. Throws InputError naming the file (and line) when
// neither is there, or it is damaged.
std::vector<ColmapImage> ReadColmapImages(const std::filesystem::path& model);

// A keypoint of COLMAP's database, with (0, 0) at the CENTRE of the top-left pixel.
struct ColmapKeypoint {
  float x = 0.0F, y = 0.0F;
  float sigma = 0.0F;  // pixels
};

// Keypoints of each image by its id. Throws InputError when the file is no COLMAP database, or its
// keypoints have no scale (not SIFT).
std::map<std::uint32_t, std::vector<ColmapKeypoint>> ReadColmapKeypoints(
    const std::filesystem::path& database);

}  // namespace lift_slam::training
