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
Trajectory PairByIndex(const TruthFile& file, const Trajectory& rows, const TruthFrames& frames,
                       std::vector<std::string>& warnings) {
  Trajectory poses;
  for (TrajectoryPose pose : rows) {
    const std::optional<std::int64_t> time_ns = frames.time_ns(pose.frame_index);
    if (!time_ns) continue;
    pose.timestamp_ns = *time_ns;
    poses.push_back(pose);
  }
  if (poses.empty()) {
    throw InputError(fmt::format("{}: none of its {} poses is of an image of the sequence",
                                 file.path.string(), rows.size()));
  }
  if (frames.count && (poses.size() < rows.size() || std::ssize(poses) < *frames.count)) {
    warnings.push_back(fmt::format("{} has {} poses for {} images; {} are paired by index",
                                   file.path.string(), rows.size(), *frames.count, poses.size()));
  }
  return poses;
}

// Files in a format that says neither seconds nor nanoseconds are judged by their first stamp.
TrajectoryFormat FormatWithUnit(const TruthFile& file) {
  const bool count_ns = file.format == TrajectoryFormat::kTum &&
                        DetectTrajectoryFormat(file.path) == TrajectoryFormat::kEurocResult;
  return count_ns ? TrajectoryFormat::kEurocResult : file.format;
}

Trajectory ReadPoses(const TruthFile& file, const TruthFrames& frames,
                     std::vector<std::string>& warnings) {
  const TrajectoryFile poses = ReadTrajectory(file.path, FormatWithUnit(file), file.nan_rows);
  if (poses.trajectory.empty()) FailWithoutPoses(file.path);
  warnings.insert(warnings.end(), poses.warnings.begin(), poses.warnings.end());
  if (!IsKitti(poses.format)) return poses.trajectory;
  return PairByIndex(file, poses.trajectory, frames, warnings);
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

TruthFrames FramesOf(const std::vector<ListedImage>& images) {
  std::map<std::int64_t, std::int64_t> times_ns;
  for (const ListedImage& image : images) times_ns[image.frame_index] = image.timestamp_ns;
  const auto time_ns =
      [times_ns = std::move(times_ns)](std::int64_t frame_index) -> std::optional<std::int64_t> {
    const auto time = times_ns.find(frame_index);
    return time == times_ns.end() ? std::nullopt : std::optional(time->second);
  };
  return {std::ssize(images), time_ns,
          TimeRange{images.front().timestamp_ns, images.back().timestamp_ns}};
}

std::optional<GroundTruth> LoadGroundTruth(const ImageList& list, const TruthFrames& frames,
                                           const SequenceOptions& options,
                                           std::vector<std::string>& warnings) {
  const std::optional<TruthFile> file = ChooseTruthFile(list, options);
  if (!file) return std::nullopt;
  GroundTruth truth;
  truth.source = file->path.string();
  truth.by_index = IsKitti(file->format);
  truth.poses = ReadPoses(*file, frames, warnings);
  if (const auto truth_from_cam = TruthFromCamera(*file, list, options)) {
    truth.body_poses = truth.poses;
    truth.poses = CameraFromBodyTrajectory(truth.poses, *truth_from_cam);
  }
  if (!frames.range) return truth;
  const auto apart =
      DescribeMissingOverlap(truth.poses, frames.range->first_ns, frames.range->last_ns);
  if (!apart) return truth;
  const std::string text =
      fmt::format("{}: shares no time with the images: {}", truth.source, *apart);
  if (options.ground_truth_file) throw InputError(text);
  warnings.push_back(text + "; it is not used");
  return std::nullopt;
}

}  // namespace lift_slam
