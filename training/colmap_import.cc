#include "training/colmap_import.h"

#include <fmt/format.h>

#include <map>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_range.h"
#include "training/colmap_reader.h"
#include "training/sift_keypoints.h"

namespace lift_slam::training {
namespace {

std::filesystem::path FindDatabase(const ColmapPaths& paths) {
  if (!paths.database.empty()) return paths.database;
  std::filesystem::path folder = std::filesystem::absolute(paths.model / ".").parent_path();
  for (int i = 0; i < 3; ++i, folder = folder.parent_path()) {
    if (std::filesystem::exists(folder / "database.db")) return folder / "database.db";
  }
  throw InputError(
      fmt::format("{}: there is no database.db in it or the two folders above; name "
                  "COLMAP's database by --database",
                  paths.model.string()));
}

std::vector<View> ToViews(const std::vector<ColmapKeypoint>& keypoints, std::uint32_t image) {
  std::vector<View> views;
  for (const ColmapKeypoint& keypoint : keypoints) {
    views.push_back({image, keypoint.x, keypoint.y, keypoint.sigma});
  }
  return views;
}

}  // namespace

void ColmapOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("part", part, kPartNames, "every tenth image is for validation");
  visitor.Field("min_sigma", min_sigma, "of keypoints, pixels");
  visitor.Field("min_views", min_views, "of a 3-D point in the whole model");
  visitor.Field("max_empty_places", max_empty_places, "of an image");
  visitor.Field("seed", seed, "of the empty places");
}

void ColmapOptions::Check() const {
  CheckOptionRange("colmap.min_sigma", min_sigma, 0.0, 50.0);
  CheckOptionRange("colmap.min_views", min_views, 2, 1000);
  CheckOptionRange("colmap.max_empty_places", max_empty_places, 0, 1000000);
}

void ImportColmap(const ColmapPaths& paths, const ImageOrigin& origin, const ColmapOptions& options,
                  const ImportProgress& progress, TrainingSetWriter& writer) {
  options.Check();
  const std::vector<ColmapImage> images = ReadColmapImages(paths.model);
  const auto keypoints = ReadColmapKeypoints(FindDatabase(paths));
  std::map<std::uint64_t, std::vector<View>> points;
  std::map<std::uint64_t, int> total_views;
  Random random(static_cast<std::uint64_t>(options.seed));
  int done = 0;
  for (const ColmapImage& image : images) {
    for (const ColmapObservation& seen : image.observations) ++total_views[seen.point];
    progress(++done, static_cast<int>(images.size()), points.size());
    if (!IsWanted(image.name, options.part)) continue;
    const auto found = keypoints.find(image.id);
    const auto grey = ReadGrayImage(paths.images / image.name);
    if (!grey || found == keypoints.end()) {
      throw InputError(
          fmt::format("{}: the image or its keypoints are missing, but the model has "
                      "it; name the folder of the images by --images",
                      (paths.images / image.name).string()));
    }
    ImageOrigin image_origin = origin;
    // Points of a reconstruction are told apart already: each image may serve as a scene.
    image_origin.name = image_origin.scene = image.name;
    const std::uint32_t number = writer.AddImage(*grey, image_origin);
    const std::vector<View> views = ToViews(found->second, number);
    for (const ColmapObservation& seen : image.observations) {
      if (seen.keypoint < views.size() && views[seen.keypoint].sigma >= options.min_sigma) {
        points[seen.point].push_back(views[seen.keypoint]);
      }
    }
    for (View& place : EmptyPlaces(*grey, views, options.max_empty_places, random)) {
      place.image = number;
      writer.AddEmptyPlace(place);
    }
  }
  for (const auto& [id, views] : points) {
    if (views.size() >= 2 && total_views[id] >= options.min_views) writer.AddPoint(views);
  }
  if (writer.num_points() == 0) {
    throw InputError(
        fmt::format("{}: no 3-D point is seen in two of the images used", paths.model.string()));
  }
}

}  // namespace lift_slam::training
