// A folder of images, with or without times.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/datasets/image_files.h"
#include "lift_slam/datasets/image_list.h"
#include "lift_slam/datasets/text_table.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

constexpr double kNominalRateHz = 30.0;

std::optional<fs::path> FindInFolders(const fs::path& folder, const fs::path& image_folder,
                                      const char* name) {
  for (const fs::path& file : {folder / name, image_folder / name}) {
    if (fs::is_regular_file(file)) return file;
  }
  return std::nullopt;
}

// One time in seconds a line, in the order of the images.
void AssignTimes(const fs::path& file, ImageList& list) {
  const std::vector<TableRow> rows = ReadTable(file, EmptyLines::kRefuseBetweenRows);
  const std::size_t num_images = list.images.size();
  if (rows.empty()) throw InputError(fmt::format("{}: holds no time", file.string()));
  if (rows.size() > num_images) {
    throw InputError(
        fmt::format("{} has {} times for {} images; expected one time for each image, in the order "
                    "of the names",
                    file.string(), rows.size(), num_images));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != 1) rows[i].Fail("one time in seconds");
    list.images[i].timestamp_ns = rows[i].SecondsAsNs(0);
  }
  if (rows.size() == num_images) return;
  list.images.resize(rows.size());
  list.warnings.push_back(
      fmt::format("{} has {} times for {} images; the {} images without a time are not used",
                  file.string(), rows.size(), num_images, num_images - rows.size()));
}

}  // namespace

ImageList ListImageFolder(const LayoutRequest& request) {
  ImageList list;
  const auto found = FindImageFolder(request.folder);
  const fs::path image_folder = found.value_or(request.folder);
  for (const fs::path& file : ListImages(image_folder)) {
    list.images.push_back({static_cast<std::int64_t>(list.images.size()), 0, file});
  }
  list.calibration_searched =
      fmt::format("{} in {}", fmt::join(CameraFileNames(), ", "), request.folder.string());
  auto calibration = FindCameraFile(request.folder);
  if (!calibration) calibration = FindCameraFile(image_folder);
  if (calibration && !request.given_camera) list.camera = ReadCameraFile(*calibration);

  if (const auto times = FindInFolders(request.folder, image_folder, "times.txt")) {
    AssignTimes(*times, list);
  } else {
    const double rate = NominalRate(request, list.camera ? list.camera : request.given_camera,
                                    kNominalRateHz, "the images have no times.txt", list.warnings);
    AssignNominalTimes(rate, list.images);
  }
  if (const auto truth = FindInFolders(request.folder, image_folder, "groundtruth.txt")) {
    list.truth = TruthFile{*truth, DetectTruthFormat(*truth)};
  }
  return list;
}

}  // namespace lift_slam
