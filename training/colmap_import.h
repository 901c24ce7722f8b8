#pragma once

#include <filesystem>

#include "lift_slam/util/options.h"
#include "training/photograph_import.h"
#include "training/training_set_writer.h"

namespace lift_slam::training {

struct ColmapOptions {
  // Every tenth image (by a hash of its name) is for validation, the others for training; points
  // are only those of their part's images.
  Part part = Part::kAll;
  double min_sigma = 1.2;     // of keypoints
  int min_views = 3;          // of a 3-D point in the whole model
  int max_empty_places = 40;  // of an image
  int seed = 1;
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

struct ColmapPaths {
  std::filesystem::path model;     // folder with images.bin or images.txt
  std::filesystem::path images;    // folder that the images' names start from
  std::filesystem::path database;  // empty: database.db in the model's folder or up to two above it
};

// Adds the images and 3-D points of a COLMAP reconstruction: the data of the papers. Throws
// InputError when something is missing, the keypoints are not SIFT, or no point is in two images.
void ImportColmap(const ColmapPaths& paths, const ImageOrigin& origin, const ColmapOptions& options,
                  const ImportProgress& progress, TrainingSetWriter& writer);

}  // namespace lift_slam::training
