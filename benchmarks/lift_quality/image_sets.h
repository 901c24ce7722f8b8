#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/image/image.h"

namespace lift_slam {

// Pairs of photographs of one kind; both by the same camera.
struct ImageSet {
  std::string name;
  Camera camera;
  double gamma = 1.0;  // for the second images, when they are used; stored without
  std::vector<std::pair<GrayImage, GrayImage>> pairs;
};

// `count` pairs spread over KITTI 00, `skip` frames apart.
ImageSet KittiPairs(const std::filesystem::path& data, int count, int skip, double gamma);
// The same of 7-Scenes RedKitchen.
ImageSet KitchenPairs(const std::filesystem::path& data, int count, int skip);

// The sets of the tables; those without data are left out, with a word on standard error.
std::vector<ImageSet> RealImageSets(const std::filesystem::path& data, int count);

}  // namespace lift_slam
