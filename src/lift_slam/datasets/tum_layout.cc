// TUM RGB-D and TUM-mono.
#include <fmt/format.h>

#include <map>
#include <set>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/datasets/image_files.h"
#include "lift_slam/datasets/image_list.h"
#include "lift_slam/datasets/text_table.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

constexpr double kTumMonoRateHz = 25.0;

Camera MakeFreiburgCamera(const PinholeIntrinsics& pinhole, const Distortion& distortion,
                          const std::string& source) {
  Camera camera;
  camera.pinhole = pinhole;
  camera.distortion = distortion;
  camera.source = source;
  return camera;
}

// The calibrations of the RGB cameras that the data set's page publishes, by the folder's name.
std::optional<Camera> KnownFreiburgCamera(const std::string& folder_name) {
  const auto has = [&](const char* long_name, const char* short_name) {
    return folder_name.find(long_name) != std::string::npos || folder_name.starts_with(short_name);
  };
  if (has("freiburg1", "fr1")) {
    return MakeFreiburgCamera({517.3, 516.5, 318.6, 255.3, 640, 480},
                              RadialTangential{0.2624, -0.9531, -0.0054, 0.0026, 1.1633},
                              "published calibration of TUM freiburg1");
  }
  if (has("freiburg2", "fr2")) {
    return MakeFreiburgCamera({520.9, 521.0, 325.1, 249.7, 640, 480},
                              RadialTangential{0.2312, -0.7849, -0.0033, -0.0001, 0.9172},
                              "published calibration of TUM freiburg2");
  }
  if (has("freiburg3", "fr3")) {
    return MakeFreiburgCamera({535.4, 539.2, 320.1, 247.6, 640, 480}, NoDistortion{},
                              "published calibration of TUM freiburg3");
  }
  return std::nullopt;
}

void ReadTumRgbdCalibration(const LayoutRequest& request, ImageList& list) {
  list.calibration_searched = fmt::format(
      "{} (and other camera file names), or a folder name with freiburg1, freiburg2 or freiburg3",
      (request.folder / "camera.yaml").string());
  if (request.given_camera) return;
  if (const auto file = FindCameraFile(request.folder)) {
    list.camera = ReadCameraFile(*file);
  } else {
    list.camera = KnownFreiburgCamera(request.folder.filename().string());
  }
}

std::map<std::int64_t, fs::path> FilesByNumber(const fs::path& image_folder) {
  std::map<std::int64_t, fs::path> files;
  for (const fs::path& file : ListImages(image_folder)) {
    const auto number = ImageNumber(file);
    if (!number) throw InputError(fmt::format("{}: its name is no number", file.string()));
    if (!files.emplace(*number, file).second) {
      throw InputError(
          fmt::format("{}: two images have the number {}", image_folder.string(), *number));
    }
  }
  return files;
}

// Lines "id time exposure" (exposure may be absent), where the id is the number of the image.
std::vector<ListedImage> ReadTumMonoTimes(const fs::path& times_file, const fs::path& image_folder,
                                          std::vector<std::string>& warnings) {
  const std::map<std::int64_t, fs::path> files = FilesByNumber(image_folder);
  const std::vector<TableRow> rows = ReadTable(times_file);
  std::set<std::int64_t> ids;
  std::vector<ListedImage> images;
  for (const TableRow& row : rows) {
    if (row.size() < 2) row.Fail("id, time in seconds and exposure");
    if (!ids.insert(row.Index(0)).second) row.Fail("an id that no line before has");
    const auto file = files.find(row.Index(0));
    if (file != files.end()) images.push_back({file->first, row.SecondsAsNs(1), file->second});
  }
  if (rows.size() != files.size() || images.size() != files.size()) {
    warnings.push_back(
        fmt::format("{} has {} times for {} images; the {} images that have one are used",
                    times_file.string(), rows.size(), files.size(), images.size()));
  }
  if (images.empty()) {
    throw InputError(fmt::format("{}: has no time for any image", times_file.string()));
  }
  return images;
}

std::vector<ListedImage> NumberTumMono(const LayoutRequest& request, const fs::path& times_file,
                                       const fs::path& image_folder, ImageList& list) {
  const double rate =
      NominalRate(request, list.camera ? list.camera : request.given_camera, kTumMonoRateHz,
                  fmt::format("{} is missing", times_file.string()), list.warnings);
  std::vector<ListedImage> images;
  for (const fs::path& file : ListImages(image_folder)) {
    const auto index = static_cast<std::int64_t>(images.size());
    images.push_back({index, 0, file});
  }
  AssignNominalTimes(rate, images);
  return images;
}

}  // namespace

ImageList ListTumRgbd(const LayoutRequest& request) {
  ImageList list;
  const fs::path index = request.folder / "rgb.txt";
  for (const TableRow& row : ReadTable(index)) {
    if (row.size() != 2) row.Fail("a time in seconds and a file name");
    list.images.push_back({static_cast<std::int64_t>(list.images.size()), row.SecondsAsNs(0),
                           request.folder / row[1]});
  }
  if (list.images.empty()) throw InputError(fmt::format("{}: lists no image", index.string()));
  ReadTumRgbdCalibration(request, list);
  const fs::path truth = request.folder / "groundtruth.txt";
  if (fs::exists(truth)) list.truth = TruthFile{truth, TrajectoryFormat::kTum};
  return list;
}

ImageList ListTumMono(const LayoutRequest& request) {
  const fs::path image_folder = request.folder / "images";
  if (!fs::is_directory(image_folder) && fs::exists(request.folder / "images.zip")) {
    throw InputError(
        fmt::format("{}: zip files are not read; unpack it into the folder images beside it",
                    (request.folder / "images.zip").string()));
  }
  ImageList list;
  const fs::path calibration = request.folder / "camera.txt";
  list.calibration_searched = calibration.string();
  if (!request.given_camera && fs::exists(calibration)) list.camera = ReadCameraFile(calibration);
  const fs::path times_file = request.folder / "times.txt";
  list.images = fs::exists(times_file) ? ReadTumMonoTimes(times_file, image_folder, list.warnings)
                                       : NumberTumMono(request, times_file, image_folder, list);
  const fs::path truth = request.folder / "groundtruthSync.txt";
  if (fs::exists(truth)) {
    list.truth = TruthFile{truth, TrajectoryFormat::kTum, NanRows::kSkip};
  }
  return list;
}

}  // namespace lift_slam
