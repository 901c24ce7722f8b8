// EuRoC MAV (ASL layout); also TUM-VI, which is laid out the same.
#include <fmt/format.h>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/datasets/image_list.h"
#include "lift_slam/datasets/keyed_file.h"
#include "lift_slam/datasets/rig_transform.h"
#include "lift_slam/datasets/text_table.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

std::vector<ListedImage> ReadImageIndex(const fs::path& camera_folder) {
  const fs::path index = camera_folder / "data.csv";
  std::vector<ListedImage> images;
  for (const TableRow& row : ReadTable(index)) {
    if (row.size() != 2) row.Fail("a time in ns and a file name");
    images.push_back(
        {static_cast<std::int64_t>(images.size()), row.Index(0), camera_folder / "data" / row[1]});
  }
  if (images.empty()) throw InputError(fmt::format("{}: lists no image", index.string()));
  return images;
}

// sensor.yaml beside the images; TUM-VI has a Kalibr file instead.
std::optional<fs::path> FindCalibration(const fs::path& root, const fs::path& camera_folder) {
  for (const fs::path& file :
       {camera_folder / "sensor.yaml", root / "dso" / "camchain.yaml", root / "camchain.yaml"}) {
    if (fs::exists(file)) return file;
  }
  return FindCameraFile(root);
}

void FindTruth(const fs::path& rig, ImageList& list) {
  for (const char* name : {"state_groundtruth_estimate0", "mocap0"}) {
    const fs::path file = rig / name / "data.csv";
    if (fs::exists(file)) {
      list.truth = TruthFile{file, TrajectoryFormat::kEurocCsv};
      break;
    }
  }
  if (!list.truth && fs::exists(rig / "leica0")) {
    list.warnings.push_back(
        fmt::format("{}: the truth in leica0 has positions only and is not used", rig.string()));
  }
  if (list.truth && !list.truth_from_cam) {
    list.warnings.push_back(
        fmt::format("{}: not used, since no T_BS says where the camera sits on the body",
                    list.truth->path.string()));
    list.truth.reset();
  }
}

}  // namespace

ImageList ListEuroc(const LayoutRequest& request) {
  const bool inside = !fs::exists(request.folder / "mav0");
  const fs::path rig = inside ? request.folder : request.folder / "mav0";
  const fs::path root = inside ? request.folder.parent_path() : request.folder;
  const LayoutRequest rig_request{rig, request.options, request.given_camera};
  const std::string camera_name = ChooseCameraFolder(rig_request, {"cam0", "cam1"}, "");

  ImageList list;
  list.images = ReadImageIndex(rig / camera_name);
  const auto calibration = FindCalibration(root, rig / camera_name);
  list.calibration_searched =
      fmt::format("{}, camchain.yaml", (rig / camera_name / "sensor.yaml").string());
  if (calibration && !request.given_camera) {
    list.camera = ReadCameraFile(*calibration, camera_name);
  }
  if (calibration) list.truth_from_cam = ReadBodyFromCamera(*calibration, camera_name);
  if (!list.truth_from_cam && request.options.camera_file) {
    list.truth_from_cam = ReadBodyFromCamera(*request.options.camera_file, camera_name);
  }
  FindTruth(rig, list);
  return list;
}

}  // namespace lift_slam
