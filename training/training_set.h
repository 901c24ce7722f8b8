#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lift_slam/image/pyramid.h"
#include "lift_slam/util/mapped_file.h"

namespace lift_slam::training {

// Where the pixels of an image came from: what the terms of weights trained on them follow from.
struct ImageOrigin {
  std::string name{};     // of the image within its source
  std::string scene{};    // images of one scene may show the same points
  std::string source{};   // package and version, track, or sequence
  std::string licence{};  // "CC-BY-2.0"; "unknown" for a user's own
  std::string author{};
};

// A keypoint as one image shows it; pixel (0, 0) is the centre of the top-left pixel.
struct View {
  std::uint32_t image = 0;
  float x = 0.0F, y = 0.0F;  // pixels at full size
  float sigma = 1.0F;        // scale, pixels
};
static_assert(sizeof(View) == 16);

// What the networks are trained on: images, points with one or more views each, and places without
// a keypoint. A folder of memory-mapped files, so that its size does not matter:
//   images.bin    for each image: number of levels, their widths and heights (uint32), the pixels
//                 of each level, row by row: the pyramid that patches are cut from
//   points.bin    first view of each point, and the number of views (uint32)
//   views.bin     View records; those of one point follow one another, the reference view first
//   empty.bin     View records of places without a keypoint, sorted by image
//   manifest.json what made it, and the origin of each image
// Patches are cut when they are needed, once, at exactly the extent, shift and rotation asked for.
// Numbers are little-endian. Points are sorted by the image of their reference view.
class TrainingSet {
 public:
  // Throws InputError naming the file when one is missing, truncated or inconsistent.
  explicit TrainingSet(const std::filesystem::path& folder);

  const std::string& name() const { return name_; }  // last part of the path
  std::size_t num_images() const { return pyramids_.size(); }
  const ImagePyramid& pyramid(std::size_t image) const { return pyramids_[image]; }
  const ImageOrigin& origin(std::size_t image) const { return origins_[image]; }

  std::size_t num_points() const { return first_views_.size() - 1; }
  std::span<const View> views(std::size_t point) const;
  std::span<const View> empty_places() const { return empty_places_; }
  // Points whose reference view is in the same image as that of `point`: [first, second).
  std::pair<std::size_t, std::size_t> NeighboursInImage(std::size_t point) const;

 private:
  void MapImages(const std::filesystem::path& path);
  void Check() const;

  std::filesystem::path folder_;
  std::string name_;
  MappedFile images_file_, points_file_, views_file_, empty_file_;
  std::vector<ImagePyramid> pyramids_;
  std::vector<ImageOrigin> origins_;
  std::span<const std::uint32_t> first_views_;
  std::span<const View> views_, empty_places_;
};

// Number of pixels sampled per level of the pyramid: enough for a patch's step of 1.5 pixels.
inline constexpr PyramidShape kTrainingPyramid{
    .num_levels = 4, .scale_factor = 2.0, .min_size_px = 2};

}  // namespace lift_slam::training
