#include <fmt/format.h>

#include <map>

#include "lift_slam/datasets/rig_transform.h"
#include "lift_slam/datasets/sequence_setup.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// KITTI rows take the times of the images they are of; rows without an image are left out.
Trajectory ReadKittiForImages(const TruthFile& file, const std::vector<ListedImage>& images,
                              std::vector<std::string>& warnings) {
  std::map<std::int64_t, std::int64_t> times_ns;
  for (const ListedImage& image : images) times_ns[image.frame_index] = image.timestamp_ns;
  const Trajectory rows = ReadKittiPoses(file.path);
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

Trajectory ReadPoses(const TruthFile& file, const std::vector<ListedImage>& images,
                     std::vector<std::string>& warnings) {
  switch (file.kind) {
    case PoseFileKind::kKitti:
      return ReadKittiForImages(file, images, warnings);
    case PoseFileKind::kEuroc:
      return ReadEurocPoses(file.path);
    case PoseFileKind::kTum:
      break;
  }
  return ReadTumPoses(file.path, file.invalid_rows, &warnings);
}

std::optional<TruthFile> ChooseTruthFile(const ImageList& list, const SequenceOptions& options) {
  if (!options.ground_truth_file) return list.truth;
  TruthFile given;
  given.path = *options.ground_truth_file;
  given.kind = DetectPoseFile(given.path);
  if (list.truth) given.invalid_rows = list.truth->invalid_rows;
  return given;
}

// TUM files hold poses of the camera; KITTI's are of camera 0 and EuRoC's of the body.
std::optional<Rigid3d> TruthFromCamera(const TruthFile& file, const ImageList& list,
                                       const SequenceOptions& options) {
  if (file.kind == PoseFileKind::kTum) return std::nullopt;
  std::optional<Rigid3d> transform = list.truth_from_cam;
  if (file.kind == PoseFileKind::kKitti) return transform;
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

std::optional<GroundTruth> LoadGroundTruth(const ImageList& list,
                                           const std::vector<ListedImage>& images,
                                           const SequenceOptions& options,
                                           std::vector<std::string>& warnings) {
  const std::optional<TruthFile> file = ChooseTruthFile(list, options);
  if (!file) return std::nullopt;
  GroundTruth truth;
  truth.source = file->path.string();
  truth.by_index = file->kind == PoseFileKind::kKitti;
  truth.poses = ReadPoses(*file, images, warnings);
  if (const auto truth_from_cam = TruthFromCamera(*file, list, options)) {
    truth.body_poses = truth.poses;
    truth.poses = TransformBody(truth.poses, *truth_from_cam);
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
