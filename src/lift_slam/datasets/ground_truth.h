#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// Reference poses of a sequence, sorted by time.
struct GroundTruth {
  Trajectory poses;  // world_from_cam of the camera that runs
  // The file's own poses (world_from_body) where they are of another frame than the camera.
  std::optional<Trajectory> body_poses;
  std::string source;     // file
  bool by_index = false;  // KITTI: paired by frame index; the poses have no times of their own
};

enum class InvalidRows { kRefuse, kSkip };

// Each reader throws InputError with file and line for a malformed row, a number that is not
// finite, or a quaternion whose norm is off by more than 1e-3. Frame indices are -1 unless said.

// "t tx ty tz qx qy qz qw", t in seconds. Times beyond 1e12 are taken as nanoseconds, which
// `warnings` then says. InvalidRows::kSkip leaves out rows whose pose is NaN (TUM-mono marks
// frames without truth so).
Trajectory ReadTumPoses(const std::filesystem::path& path, InvalidRows invalid_rows,
                        std::vector<std::string>* warnings);
// 12 numbers (row n is frame n) or 13 (the frame index first), a row-major 3x4 matrix. Frame
// indices are set, times are 0.
Trajectory ReadKittiPoses(const std::filesystem::path& path);
// EuRoC csv: time in ns, position, quaternion w x y z, of the body.
Trajectory ReadEurocPoses(const std::filesystem::path& path);

enum class PoseFileKind { kTum, kKitti, kEuroc };
// From the first row; throws InputError when it is none of them.
PoseFileKind DetectPoseFile(const std::filesystem::path& path);

// Each pose times `body_from_cam`: world_from_body becomes world_from_cam.
Trajectory TransformBody(const Trajectory& poses, const Rigid3d& body_from_cam);

// One sentence when the two time ranges have no overlap, with both ranges and, where they differ
// as seconds and nanoseconds do, that suspicion. Nothing when they overlap.
std::optional<std::string> DescribeMissingOverlap(const Trajectory& truth,
                                                  std::int64_t first_frame_ns,
                                                  std::int64_t last_frame_ns);

}  // namespace lift_slam
