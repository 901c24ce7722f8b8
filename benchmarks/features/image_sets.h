#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/image/image.h"

namespace lift_slam {

// Pairs of photographs of one kind; both by the same camera, if it is known. An image that several
// sets hold has the same pixels in memory.
struct ImageSet {
  std::string name;
  std::optional<Camera> camera;  // none: pairs fulfil a fundamental matrix
  double gamma = 1.0;            // for the second images, when they are used; stored without
  std::vector<std::pair<GrayImage, GrayImage>> pairs;
};

// The sets of the tables, `count` pairs each: KITTI 00 1 and 5 frames apart, the latter also with
// gamma 0.25, 0.5, 2 and 4; RedKitchen 10 frames apart. Those without data are left out, with a
// word on standard error.
std::vector<ImageSet> RealImageSets(const std::filesystem::path& data, int count);

// The first and the last of these sets; the last only when its first images are others.
std::vector<ImageSet> OneOfEachKind(const std::vector<ImageSet>& sets);

// Two images of one scene, of unknown calibration; named after the files.
ImageSet SinglePair(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lift_slam
