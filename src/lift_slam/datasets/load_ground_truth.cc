#include <fmt/format.h>

#include <map>

#include "lift_slam/datasets/rig_transform.h"
#include "lift_slam/datasets/sequence_setup.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

[[noreturn]] void FailWithoutPoses(const std::filesystem::path& path) {
  throw InputError(fmt::format("{}: the file holds no pose", path.string()));
}

// KITTI poses take the times of the images they are of; those without an image are left out.
Trajectory PairByIndex(const TruthFile& file, const Trajectory& rows,
                       const std::vector<ListedImage>& images, std::vector<std::string>& warnings) {
  std::map<std::int64_t, std::int64_t> times_ns;
  for (const ListedImage& image : images) times_ns[image.frame_index] = image.timestamp_ns;
  Trajectory poses;
  for (TrajectoryPose pose : rows) {
    const auto time = times_ns.find(pose.frame_index);
    if (time == times_ns.end()) continue;
    pose.timestamp_ns = time->second;
    poses.push_back(pose);
  }
  if (poses.empty()) {
    throw InputError(fmt::format("{}: none of its {} poses is of an image of the sequence",
                                 file.path.string(), rows.size()));
  }
  if (poses.size() < rows.size() || poses.size() < images.size()) {
    warnings.push_back(fmt::format("{} has {} poses for {} images; {} are paired by index",
                                   file.path.string(), rows.size(), images.size(), poses.size()));
  }
  return poses;
}

// Files in a format that says neither seconds nor nanoseconds are judged by their first stamp.
TrajectoryFormat FormatWithUnit(const TruthFile& file) {
  const bool count_ns = file.format == TrajectoryFormat::kTum &&
                        DetectTrajectoryFormat(file.path) == TrajectoryFormat::kEurocResult;
  return count_ns ? TrajectoryFormat::kEurocResult : file.format;
}

Trajectory ReadPoses(const TruthFile& file, const std::vector<ListedImage>& images,
                     std::vector<std::string>& warnings) {
  const TrajectoryFile poses = ReadTrajectory(file.path, FormatWithUnit(file), file.nan_rows);
  if (poses.trajectory.empty()) FailWithoutPoses(file.path);
  warnings.insert(warnings.end(), poses.warnings.begin(), poses.warnings.end());
  if (!IsKitti(poses.format)) return poses.trajectory;
  return PairByIndex(file, poses.trajectory, images, warnings);
}

std::optional<TruthFile> ChooseTruthFile(const ImageList& list, const SequenceOptions& options) {
  if (!options.ground_truth_file) return list.truth;
  TruthFile given;
  given.path = *options.ground_truth_file;
  given.format = DetectTruthFormat(given.path);
  if (list.truth) given.nan_rows = list.truth->nan_rows;
  return given;
}

// TUM files hold poses of the camera; KITTI's are of camera 0 and EuRoC's of the body.
std::optional<Rigid3d> TruthFromCamera(const TruthFile& file, const ImageList& list,
                                       const SequenceOptions& options) {
  if (!IsKitti(file.format) && file.format != TrajectoryFormat::kEurocCsv) return std::nullopt;
  std::optional<Rigid3d> transform = list.truth_from_cam;
  if (IsKitti(file.format)) return transform;
  if (!transform && options.camera_file) {
    transform = ReadBodyFromCamera(*options.camera_file, options.camera_name);
  }
  if (!transform) {
    throw InputError(fmt::format(
        "{}: gives poses of the body, but no calibration says where the camera sits on it (T_BS)",
        file.path.string()));
  }
  return transform;
}

}  // namespace

TrajectoryFormat DetectTruthFormat(const std::filesystem::path& path) {
  const std::optional<TrajectoryFormat> format = DetectTrajectoryFormat(path);
  if (!format) FailWithoutPoses(path);
  return *format;
}

std::optional<GroundTruth> LoadGroundTruth(const ImageList& list,
                                           const std::vector<ListedImage>& images,
                                           const SequenceOptions& options,
                                           std::vector<std::string>& warnings) {
  const std::optional<TruthFile> file = ChooseTruthFile(list, options);
  if (!file) return std::nullopt;
  GroundTruth truth;
  truth.source = file->path.string();
  truth.by_index = IsKitti(file->format);
  truth.poses = ReadPoses(*file, images, warnings);
  if (const auto truth_from_cam = TruthFromCamera(*file, list, options)) {
    truth.body_poses = truth.poses;
    truth.poses = CameraFromBodyTrajectory(truth.poses, *truth_from_cam);
  }
  const auto apart =
      DescribeMissingOverlap(truth.poses, images.front().timestamp_ns, images.back().timestamp_ns);
  if (!apart) return truth;
  const std::string text =
      fmt::format("{}: shares no time with the images: {}", truth.source, *apart);
  if (options.ground_truth_file) throw InputError(text);
  warnings.push_back(text + "; it is not used");
  return std::nullopt;
}

}  // namespace lift_slam
