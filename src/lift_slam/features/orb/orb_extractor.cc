#include "lift_slam/features/orb/orb_extractor.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <exception>
#include <thread>

#include "lift_slam/features/orb/corner_orientation.h"
#include "lift_slam/features/orb/corner_refinement.h"
#include "lift_slam/image/image_library.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_root.h"
#include "lift_slam/util/option_writer.h"

namespace lift_slam {
namespace {

// Splits `total` over the levels in proportion to 1 / scale, as the levels' side lengths.
std::vector<int> FeaturesPerLevel(int total, int num_levels, double scale_factor) {
  double weight_sum = 0.0;
  for (int level = 0; level < num_levels; ++level) weight_sum += std::pow(scale_factor, -level);
  std::vector<int> counts;
  double weight_so_far = 0.0;
  int given = 0;
  for (int level = 0; level < num_levels; ++level) {
    weight_so_far += std::pow(scale_factor, -level);
    const int until_here = static_cast<int>(std::lround(total * weight_so_far / weight_sum));
    counts.push_back(until_here - given);
    given = until_here;
  }
  return counts;
}

}  // namespace

OrbExtractor::OrbExtractor(const OrbOptions& options) : options_(options) {
  options_.Check();
  scale_levels_ = {options_.num_levels, options_.scale_factor, options_.sigma_px};
  scratch_.resize(static_cast<std::size_t>(options_.num_threads));
}

FeatureSet OrbExtractor::Extract(const GrayImage& image) {
  if (std::max(image.width(), image.height()) > Corner::kMaxPosition) {
    throw InputError(fmt::format("the image has {} x {} pixels; ORB takes up to {} a side",
                                 image.width(), image.height(), Corner::kMaxPosition));
  }
  RebuildPyramid(image,
                 {.num_levels = options_.num_levels,
                  .scale_factor = options_.scale_factor,
                  .min_size_px = 2 * OrbDescriptor::kBorder + 1},
                 pyramid_);
  const std::vector<LevelFeatures> levels = ExtractLevels(
      pyramid_, FeaturesPerLevel(FeatureCount(options_, image.width(), image.height()),
                                 options_.num_levels, options_.scale_factor));
  FeatureSet features;
  for (const LevelFeatures& level : levels) {
    features.keypoints.insert(features.keypoints.end(), level.keypoints.begin(),
                              level.keypoints.end());
  }
  features.descriptors = Descriptors(kind_, features.keypoints.size());
  std::byte* out = features.descriptors.mutable_data();
  for (const LevelFeatures& level : levels) {
    if (level.descriptors.empty()) continue;
    std::memcpy(out, level.descriptors.data(), level.descriptors.size());
    out += level.descriptors.size();
  }
  return features;
}

std::vector<OrbExtractor::LevelFeatures> OrbExtractor::ExtractLevels(
    const ImagePyramid& pyramid, const std::vector<int>& counts) {
  std::vector<LevelFeatures> levels(pyramid.size());
  std::vector<std::exception_ptr> errors(scratch_.size());
  std::atomic<std::size_t> next{0};
  // Each thread takes the next level, the largest first; a level does not depend on the others.
  const auto work = [&](std::size_t thread) {
    try {
      for (std::size_t i = next++; i < pyramid.size(); i = next++) {
        levels[i] = ExtractLevel(pyramid[i], static_cast<int>(i), counts[i], scratch_[thread]);
      }
    } catch (...) {
      errors[thread] = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::size_t i = 1; i < scratch_.size(); ++i) threads.emplace_back(work, i);
    work(0);
  }
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
  return levels;
}

OrbExtractor::LevelFeatures OrbExtractor::ExtractLevel(const PyramidLevel& level, int level_index,
                                                       int count, Scratch& scratch) const {
  const std::vector<Corner> corners = DetectCorners(level.image, count, scratch);
  LevelFeatures features;
  std::vector<OrientedCorner> oriented;
  features.keypoints.reserve(corners.size());
  oriented.reserve(corners.size());
  for (const Corner& corner : corners) {
    const float angle_rad = IntensityCentroidAngle(level.image, corner.x, corner.y);
    const RefinedPosition position =
        options_.subpixel
            ? RefineCorner(scratch.scores, corner)
            : RefinedPosition{static_cast<float>(corner.x), static_cast<float>(corner.y)};
    oriented.push_back({corner.x, corner.y, angle_rad});
    features.keypoints.push_back({.x = static_cast<float>(level.FullX(position.x)),
                                  .y = static_cast<float>(level.FullY(position.y)),
                                  .angle_rad = angle_rad,
                                  .response = static_cast<float>(corner.score),
                                  .level = level_index});
  }
  features.descriptors.resize(corners.size() * OrbDescriptor::kBytes);
  scratch.descriptor.Describe(level.image, oriented, features.descriptors.data());
  return features;
}

std::vector<Corner> OrbExtractor::DetectCorners(const GrayImage& image, int count,
                                                Scratch& scratch) const {
  constexpr int kBorder = OrbDescriptor::kBorder;
  const PixelRectangle area{kBorder, kBorder, image.width() - kBorder, image.height() - kBorder};
  scratch.scores.Compute(image, kBorder);
  scratch.scores.FindCorners(options_.min_fast_threshold, scratch.corners);
  DropWeakCorners(area, options_.cell_size_px, options_.fast_threshold, scratch.corners);
  return SpreadCorners(area, count, scratch.corners);
}

std::unique_ptr<FeatureExtractor> CreateOrbExtractor(const OrbOptions& options) {
  return std::make_unique<OrbExtractor>(options);
}

std::string OrbIdentity(OrbOptions options) {
  const OrbOptions defaults;
  options.num_threads = defaults.num_threads;
  options.sigma_px = defaults.sigma_px;
  return fmt::format("orb, {}\n{}", ImageLibraryVersion(), OptionsToYaml(MakeOptionRoot(options)));
}

}  // namespace lift_slam
