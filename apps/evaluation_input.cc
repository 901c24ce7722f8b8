#include "apps/evaluation_input.h"

#include <fmt/format.h>

#include "lift_slam/datasets/rig_transform.h"
#include "lift_slam/evaluation/association.h"
#include "lift_slam/evaluation/coverage.h"
#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// The format a user's word stands for; "kitti" and "euroc" name two each, told apart by content.
std::optional<TrajectoryFormat> FormatFromName(const std::string& name, const std::string& path) {
  if (name == "auto") return std::nullopt;
  if (name == "tum") return TrajectoryFormat::kTum;
  const std::optional<TrajectoryFormat> detected = DetectTrajectoryFormat(path);
  if (name == "kitti") {
    return detected == TrajectoryFormat::kKittiIndexed ? TrajectoryFormat::kKittiIndexed
                                                       : TrajectoryFormat::kKitti;
  }
  return detected == TrajectoryFormat::kEurocCsv ? TrajectoryFormat::kEurocCsv
                                                 : TrajectoryFormat::kEurocResult;
}

// Where the camera sits on the body, which the file must say.
Rigid3d RequireBodyFromCamera(const std::string& sensor_yaml) {
  const auto body_from_cam = ReadBodyFromCamera(sensor_yaml, /*camera_name=*/"cam0");
  if (body_from_cam) return *body_from_cam;
  throw InputError(fmt::format("{}: no T_BS.data, expected 16 numbers", sensor_yaml));
}

// The sensor file that lies beside EuRoC's ground truth in the published folders.
std::string FindSensorYaml(const std::string& reference) {
  const std::filesystem::path mav =
      std::filesystem::absolute(reference).parent_path().parent_path();
  const std::filesystem::path sensor = mav / "cam0" / "sensor.yaml";
  return std::filesystem::exists(sensor) ? sensor.string() : std::string();
}

// Brings the reference into the frame the options ask for.
void ChooseReferenceFrame(const EvaluationFiles& files, const EvaluationOptions& options,
                          EvaluationInput& input) {
  if (options.gt_frame == GroundTruthFrame::kBody) return;
  std::string sensor_yaml = files.sensor_yaml;
  if (sensor_yaml.empty()) {
    if (input.reference_format != TrajectoryFormat::kEurocCsv) return;  // of the camera
    sensor_yaml = FindSensorYaml(files.reference);
    if (sensor_yaml.empty()) {
      throw InputError(fmt::format(
          "{} holds poses of the body: give --sensor-yaml (cam0/sensor.yaml) to compare with the "
          "camera, or --gt-frame body to compare with the body all the same",
          files.reference));
    }
    input.warnings.push_back(fmt::format("camera on the body taken from {}", sensor_yaml));
  }
  input.reference = CameraFromBodyTrajectory(input.reference, RequireBodyFromCamera(sensor_yaml));
}

void SetTimes(const std::vector<std::int64_t>& times_ns, const std::string& path,
              Trajectory& trajectory) {
  for (TrajectoryPose& pose : trajectory) {
    if (pose.frame_index >= static_cast<std::int64_t>(times_ns.size())) {
      throw InputError(fmt::format("{}: {} times, but the trajectory has a frame {}", path,
                                   times_ns.size(), pose.frame_index));
    }
    pose.timestamp_ns = times_ns[static_cast<std::size_t>(pose.frame_index)];
  }
}

TrajectoryFile ReadFile(const std::string& path, const std::string& format_name,
                        EvaluationInput& input) {
  TrajectoryFile file = ReadTrajectory(path, FormatFromName(format_name, path));
  input.warnings.insert(input.warnings.end(), file.warnings.begin(), file.warnings.end());
  return file;
}

}  // namespace

EvaluationInput LoadEvaluationInput(const EvaluationFiles& files, EvaluationOptions& options) {
  EvaluationInput input;
  TrajectoryFile reference = ReadFile(files.reference, files.reference_format, input);
  TrajectoryFile estimate = ReadFile(files.estimate, files.format, input);
  options.estimate_lists_every_frame = false;
  if (!files.times.empty()) {
    const std::vector<std::int64_t> times_ns = ReadTimestamps(files.times);
    if (reference.nominal_timestamps) SetTimes(times_ns, files.times, reference.trajectory);
    if (estimate.nominal_timestamps) SetTimes(times_ns, files.times, estimate.trajectory);
    estimate.trajectory = WithEveryFrame(estimate.trajectory, times_ns);
    options.estimate_lists_every_frame = true;
  }
  const AssociationMethod method =
      ResolveMethod(estimate.trajectory, reference.trajectory, options.association.method);
  const bool nominal = reference.nominal_timestamps || estimate.nominal_timestamps;
  if (method == AssociationMethod::kTime && nominal && files.times.empty()) {
    throw InputError(fmt::format("{} holds no times: give the times of the frames with --times",
                                 reference.nominal_timestamps ? files.reference : files.estimate));
  }
  input.estimate = std::move(estimate.trajectory);
  input.reference = std::move(reference.trajectory);
  input.estimate_format = estimate.format;
  input.reference_format = reference.format;
  ChooseReferenceFrame(files, options, input);
  return input;
}

}  // namespace lift_slam
