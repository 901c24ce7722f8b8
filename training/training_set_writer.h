#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/image/image.h"
#include "training/training_set.h"

namespace lift_slam::training {

inline constexpr std::string_view kTrainingSetFormat = "lift_slam training set 1";

// Writes a training set (training_set.h). Images first or points first does not matter, but the
// views of a point may only name images that were added. A set that is in the folder stays as it is
// until Finish, which replaces it: the manifest, without which nobody reads it, is written last.
class TrainingSetWriter {
 public:
  // Makes the folder. Throws InputError when it cannot be written, or holds a COLMAP model.
  explicit TrainingSetWriter(const std::filesystem::path& folder);
  ~TrainingSetWriter();  // what was written without Finish is removed
  TrainingSetWriter(const TrainingSetWriter&) = delete;
  TrainingSetWriter& operator=(const TrainingSetWriter&) = delete;

  // Its number, counted from 0. Throws InputError when the disk is full.
  std::uint32_t AddImage(const GrayImage& image, const ImageOrigin& origin);
  // At least one view, the reference view first.
  void AddPoint(std::span<const View> views);
  void AddEmptyPlace(const View& place) { empty_places_.push_back(place); }

  std::size_t num_images() const { return origins_.size(); }
  std::size_t num_points() const { return points_.size(); }

  // `description` goes into the manifest: command and options. Throws InputError when there is no
  // point, or the disk is full.
  void Finish(const std::string& description);

 private:
  void CheckImagesAreWritten() const;
  void TakePlaceOfOldSet();
  void WritePoints();
  void WriteManifest(const std::string& description);

  std::filesystem::path folder_, unfinished_images_;
  std::ofstream images_;
  bool is_finished_ = false;
  std::vector<ImageOrigin> origins_;
  std::vector<std::vector<View>> points_;
  std::vector<View> empty_places_;
};

}  // namespace lift_slam::training
