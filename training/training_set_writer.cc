#include "training/training_set_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "lift_slam/util/check.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam::training {
namespace {

void WriteNumber(std::ostream& stream, std::size_t number) {
  const auto value = static_cast<std::uint32_t>(number);
  stream.write(reinterpret_cast<const char*>(&value), sizeof value);
}

// COLMAP's images.bin is another file of the same name.
void RefuseColmapModel(const std::filesystem::path& folder) {
  for (const char* name : {"cameras.bin", "cameras.txt", "points3D.bin", "points3D.txt"}) {
    if (!std::filesystem::exists(folder / name)) continue;
    throw InputError(
        fmt::format("{}: holds a COLMAP model ({}); choose another folder for the training set",
                    folder.string(), name));
  }
}

template <class Record>
void WriteRecords(const std::filesystem::path& path, std::span<const Record> records) {
  WriteFileAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(records.data()),
                 static_cast<std::streamsize>(records.size_bytes()));
  });
}

}  // namespace

TrainingSetWriter::TrainingSetWriter(const std::filesystem::path& folder)
    : folder_(folder), unfinished_images_(folder / "images.bin.part") {
  RefuseColmapModel(folder);
  CreateFolder(folder);
  images_.open(unfinished_images_, std::ios::binary | std::ios::trunc);
  if (!images_) {
    throw InputError(fmt::format("{}: cannot be written", unfinished_images_.string()));
  }
}

TrainingSetWriter::~TrainingSetWriter() {
  if (is_finished_) return;
  images_.close();
  std::error_code ignored;
  std::filesystem::remove(unfinished_images_, ignored);
}

std::uint32_t TrainingSetWriter::AddImage(const GrayImage& image, const ImageOrigin& origin) {
  const ImagePyramid pyramid = BuildPyramid(image, kTrainingPyramid);
  WriteNumber(images_, pyramid.size());
  for (const PyramidLevel& level : pyramid) {
    WriteNumber(images_, static_cast<std::size_t>(level.image.width()));
    WriteNumber(images_, static_cast<std::size_t>(level.image.height()));
  }
  for (const PyramidLevel& level : pyramid) {
    for (int y = 0; y < level.image.height(); ++y) {
      images_.write(reinterpret_cast<const char*>(level.image.row(y)), level.image.width());
    }
  }
  CheckImagesAreWritten();
  origins_.push_back(origin);
  return static_cast<std::uint32_t>(origins_.size() - 1);
}

void TrainingSetWriter::AddPoint(std::span<const View> views) {
  LIFT_SLAM_CHECK(!views.empty(), "a point without views");
  points_.emplace_back(views.begin(), views.end());
}

void TrainingSetWriter::Finish(const std::string& description) {
  if (points_.empty()) {
    throw InputError(fmt::format("{}: no points to train on were found in {} images",
                                 folder_.string(), origins_.size()));
  }
  images_.close();
  CheckImagesAreWritten();
  TakePlaceOfOldSet();
  WritePoints();
  WriteManifest(description);
}

void TrainingSetWriter::CheckImagesAreWritten() const {
  if (images_) return;
  throw InputError(fmt::format("{}: cannot be written (disk full?)", unfinished_images_.string()));
}

// From here to the new manifest the folder holds no set: half of each would be worse.
void TrainingSetWriter::TakePlaceOfOldSet() {
  std::error_code error;
  std::filesystem::remove(folder_ / "manifest.json", error);
  if (!error) std::filesystem::rename(unfinished_images_, folder_ / "images.bin", error);
  if (error) {
    throw InputError(
        fmt::format("{}: the set cannot be replaced: {}", folder_.string(), error.message()));
  }
  is_finished_ = true;
}

void TrainingSetWriter::WritePoints() {
  const auto by_image = [](const View& a, const View& b) { return a.image < b.image; };
  std::stable_sort(points_.begin(), points_.end(),
                   [&](const auto& a, const auto& b) { return by_image(a[0], b[0]); });
  std::stable_sort(empty_places_.begin(), empty_places_.end(), by_image);
  std::vector<std::uint32_t> first_views = {0};
  std::vector<View> views;
  for (const std::vector<View>& point : points_) {
    views.insert(views.end(), point.begin(), point.end());
    first_views.push_back(static_cast<std::uint32_t>(views.size()));
  }
  WriteRecords<std::uint32_t>(folder_ / "points.bin", first_views);
  WriteRecords<View>(folder_ / "views.bin", views);
  WriteRecords<View>(folder_ / "empty.bin", empty_places_);
}

void TrainingSetWriter::WriteManifest(const std::string& description) {
  nlohmann::json images = nlohmann::json::array();
  for (const ImageOrigin& origin : origins_) {
    images.push_back({{"name", origin.name},
                      {"scene", origin.scene},
                      {"source", origin.source},
                      {"licence", origin.licence},
                      {"author", origin.author}});
  }
  const nlohmann::json manifest = {{"format", kTrainingSetFormat},
                                   {"description", description},
                                   {"points", points_.size()},
                                   {"empty_places", empty_places_.size()},
                                   {"images", images}};
  // Names of files need not be UTF-8.
  WriteTextAtomically(folder_ / "manifest.json",
                      manifest.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace lift_slam::training
