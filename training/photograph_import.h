#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "lift_slam/util/options.h"
#include "training/training_set_writer.h"

namespace lift_slam::training {

enum class Part { kAll, kTraining, kValidation };
inline constexpr std::string_view kPartNames[] = {"all", "training", "validation"};

// Whether an image of this name belongs to a part.
bool IsWanted(const std::string& name, Part part);

struct PhotographOptions {
  // Every tenth image (by a hash of its name) is for validation, the others for training.
  Part part = Part::kAll;
  // Images whose source contains one of these words, separated by blanks; empty: all.
  std::string sources = {};
  int max_side_px = 1280;      // larger images are made smaller, averaging
  double min_sigma = 1.2;      // of keypoints
  int max_points = 1500;       // of an image, the strongest
  int num_warps = 4;           // a point must be found again in at least one of so many views
  int max_empty_places = 300;  // of an image
  int seed = 1;
  void Visit(OptionVisitor& visitor);
  void Check() const;
};

// Reports what was done; the arguments are images done, of all, and points so far.
using ImportProgress = std::function<void(int done, int total, std::size_t points)>;

// Adds the photographs of a folder and the folders below it. manifest.tsv there (file, licence,
// author, package, ...; tools/install_training_images writes it) says which and where they come
// from; without it all images are taken, of unknown licence. Throws InputError when there are none.
void ImportPhotographs(const std::filesystem::path& folder, const PhotographOptions& options,
                       const ImportProgress& progress, TrainingSetWriter& writer);

}  // namespace lift_slam::training
