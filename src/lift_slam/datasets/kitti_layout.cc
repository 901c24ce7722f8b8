// KITTI odometry and KITTI raw.
#include <fmt/format.h>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/datasets/date_text.h"
#include "lift_slam/datasets/image_files.h"
#include "lift_slam/datasets/image_list.h"
#include "lift_slam/datasets/kitti_calibration.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

constexpr double kKittiRateHz = 10.0;

// Images numbered by their names, so that a missing file does not shift times and truth; by
// position, with a warning, when some name is no number.
std::vector<ListedImage> ListNumbered(const fs::path& folder, std::vector<std::string>& warnings) {
  const std::vector<fs::path> files = ListImages(folder);
  const bool numbered = std::all_of(files.begin(), files.end(), [](const fs::path& file) {
    return ImageNumber(file).has_value();
  });
  if (!numbered) {
    warnings.push_back(fmt::format(
        "{}: not all images are named by a number; they are counted in the order of their names",
        folder.string()));
  }
  std::vector<ListedImage> images;
  for (const fs::path& file : files) {
    const auto position = static_cast<std::int64_t>(images.size());
    images.push_back({numbered ? *ImageNumber(file) : position, 0, file});
  }
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (images[i].frame_index == images[i - 1].frame_index) {
      throw InputError(
          fmt::format("{}: two images have the number {}", folder.string(), images[i].frame_index));
    }
  }
  // Without a sum that the largest numbers would overflow.
  const std::int64_t steps = static_cast<std::int64_t>(images.size()) - 1;
  const std::int64_t missing = images.back().frame_index - images.front().frame_index - steps;
  if (missing > 0) {
    warnings.push_back(fmt::format("{}: {} images are missing between {} and {}", folder.string(),
                                   missing, images.front().frame_index, images.back().frame_index));
  }
  return images;
}

// Time i belongs to the image numbered i; images without a time are left out.
void AssignTimes(const std::vector<std::int64_t>& times_ns, const fs::path& times_file,
                 ImageList& list) {
  const std::size_t num_images = list.images.size();
  std::vector<ListedImage> timed;
  for (ListedImage& image : list.images) {
    if (image.frame_index >= static_cast<std::int64_t>(times_ns.size())) continue;
    image.timestamp_ns = times_ns[static_cast<std::size_t>(image.frame_index)];
    timed.push_back(image);
  }
  if (timed.size() < num_images) {
    list.warnings.push_back(
        fmt::format("{} has {} times for {} images; the {} images without a time are not used",
                    times_file.string(), times_ns.size(), num_images, num_images - timed.size()));
  }
  if (timed.empty()) {
    throw InputError(fmt::format("{}: has {} times, none for the images numbered {} to {}",
                                 times_file.string(), times_ns.size(),
                                 list.images.front().frame_index, list.images.back().frame_index));
  }
  list.images = std::move(timed);
}

void AssumeTimes(const LayoutRequest& request, const fs::path& times_file, ImageList& list) {
  const double rate = NominalRate(request, request.given_camera, kKittiRateHz,
                                  fmt::format("{} is missing", times_file.string()), list.warnings);
  AssignNominalTimes(rate, list.images);
}

std::vector<std::int64_t> ReadTimes(const fs::path& file) {
  std::vector<std::int64_t> times_ns;
  for (const TableRow& row : ReadTable(file, EmptyLines::kRefuseBetweenRows)) {
    if (row.size() != 1) row.Fail("one time in seconds");
    times_ns.push_back(row.SecondsAsNs(0));
  }
  return times_ns;
}

std::vector<std::int64_t> ReadDates(const fs::path& file) {
  std::vector<std::int64_t> times_ns;
  for (const TableRow& row : ReadTable(file, EmptyLines::kRefuseBetweenRows)) {
    const auto time_ns = row.size() == 2 ? ParseDateAsNs(row[0], row[1]) : std::nullopt;
    if (!time_ns) row.Fail("a date and time such as 2011-09-26 13:02:25.964389445");
    times_ns.push_back(*time_ns);
  }
  return times_ns;
}

// Sets the calibration of a rectified camera and where it sits beside camera 0.
void ReadRectified(const fs::path& file, const std::string& camera_name, ImageList& list) {
  const auto row = FindKittiProjectionRow(ReadTable(file), camera_name);
  if (!row) {
    throw InputError(fmt::format("{}: there is no line 'P{}:' (projection of {})", file.string(),
                                 camera_name.back(), camera_name));
  }
  const KittiProjection projection = ReadKittiProjection(file, *row);
  list.camera = projection.camera;
  if (projection.offset.norm() > 0.0) {
    list.truth_from_cam = Rigid3d(Eigen::Quaterniond::Identity(), -projection.offset);
  }
}

// KITTI raw publishes rectified (sync) and unrectified (extract) images with one calibration file;
// the image size tells which these are.
void ReadRawCalibration(const fs::path& file, const std::string& camera_name, ImageList& list) {
  ReadRectified(file, camera_name, list);
  const PinholeIntrinsics& rectified = list.camera->pinhole;
  const auto first = ReadWholeImage(list.images.front().file, nullptr);
  if (!first || rectified.width == 0 ||
      (first->width() == rectified.width && first->height() == rectified.height)) {
    return;
  }
  const Camera raw = ReadKittiUnrectified(file, camera_name);
  if (raw.pinhole.width == first->width() && raw.pinhole.height == first->height()) {
    list.camera = raw;
  }
}

}  // namespace

ImageList ListKittiOdometry(const LayoutRequest& request) {
  ImageList list;
  const std::string camera_name =
      ChooseCameraFolder(request, {"image_0", "image_2", "image_1", "image_3"}, "");
  list.images = ListNumbered(request.folder / camera_name, list.warnings);
  const fs::path times_file = request.folder / "times.txt";
  if (fs::exists(times_file)) {
    AssignTimes(ReadTimes(times_file), times_file, list);
  } else {
    AssumeTimes(request, times_file, list);
  }
  const fs::path calibration = request.folder / "calib.txt";
  list.calibration_searched = fmt::format("{} (line P{}:), camera.yaml beside it",
                                          calibration.string(), camera_name.back());
  if (!request.given_camera && fs::exists(calibration)) {
    ReadRectified(calibration, camera_name, list);
  } else if (const auto file = FindCameraFile(request.folder); !request.given_camera && file) {
    list.camera =
        ReadCameraFile(*file);  // of a camera with distortion, which calib.txt cannot hold
  }
  const fs::path truth = request.folder.parent_path().parent_path() / "poses" /
                         (request.folder.filename().string() + ".txt");
  if (fs::exists(truth)) list.truth = TruthFile{truth, TrajectoryFormat::kKitti};
  return list;
}

ImageList ListKittiRaw(const LayoutRequest& request) {
  ImageList list;
  const std::string camera_name =
      ChooseCameraFolder(request, {"image_00", "image_02", "image_01", "image_03"}, "data");
  list.images = ListNumbered(request.folder / camera_name / "data", list.warnings);
  const fs::path times_file = request.folder / camera_name / "timestamps.txt";
  if (fs::exists(times_file)) {
    AssignTimes(ReadDates(times_file), times_file, list);
  } else {
    AssumeTimes(request, times_file, list);
  }
  const std::vector<fs::path> candidates = {request.folder.parent_path() / "calib_cam_to_cam.txt",
                                            request.folder / "calib_cam_to_cam.txt",
                                            request.folder / "calib.txt"};
  for (const fs::path& file : candidates) {
    list.calibration_searched += (list.calibration_searched.empty() ? "" : ", ") + file.string();
    if (!request.given_camera && !list.camera && fs::exists(file)) {
      ReadRawCalibration(file, camera_name, list);
    }
  }
  return list;
}

}  // namespace lift_slam
