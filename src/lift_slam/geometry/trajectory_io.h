#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/geometry/trajectory.h"

namespace lift_slam {

// Text formats of trajectories; one pose a line, metres, target world, source camera or body.
enum class TrajectoryFormat {
  kTum,           // t[s] tx ty tz qx qy qz qw
  kKitti,         // 12 numbers, row-major 3x4; line n is frame n
  kKittiIndexed,  // 13 numbers: frame index, then as KITTI; for trajectories with gaps
  kEurocCsv,      // t[ns],px,py,pz,qw,qx,qy,qz[,...]: ground truth, pose of the body (IMU)
  kEurocResult,   // TUM columns, t in ns (above 1e12) or s
};

std::string_view Name(TrajectoryFormat format);

// Whether the format's lines are frames without times.
inline bool IsKitti(TrajectoryFormat format) {
  return format == TrajectoryFormat::kKitti || format == TrajectoryFormat::kKittiIndexed;
}

// What to do with rows that hold a NaN; TUM-mono marks frames without truth so. kSkip is of the
// formats with times only.
enum class NanRows { kRefuse, kSkip };

struct TrajectoryFile {
  // Sorted by time, stamps strictly increasing, all poses kOk. KITTI formats set frame_index and
  // the nominal stamp frame_index * 100 ms (10 Hz); the others leave frame_index at -1.
  Trajectory trajectory;
  TrajectoryFormat format = TrajectoryFormat::kTum;
  bool nominal_timestamps = false;    // KITTI: the file holds no time
  std::vector<std::string> warnings;  // what had to be decided or repaired, for the user to see
};

// The format a file's first pose line shows. Throws InputError when none fits; nothing when the
// file holds no pose.
std::optional<TrajectoryFormat> DetectTrajectoryFormat(const std::filesystem::path& path);

// Reads a trajectory; without `format` it is detected. Throws InputError with file and line for a
// wrong number of columns, a number that is none or not finite, a rotation that is none (norm of
// the quaternion off by more than 1e-3), a stamp outside 64-bit nanoseconds, indices that do not
// increase. Stamps out of order are sorted and of equal stamps the first is kept, with a warning.
// A file without poses gives an empty trajectory and a warning.
TrajectoryFile ReadTrajectory(const std::filesystem::path& path,
                              std::optional<TrajectoryFormat> format = std::nullopt,
                              NanRows nan_rows = NanRows::kRefuse);

// One stamp in seconds a line (KITTI times.txt), strictly increasing, as nanoseconds.
std::vector<std::int64_t> ReadTimestamps(const std::filesystem::path& path);

// Writes the kOk poses, 12 decimals, stamps exact. kKitti is written with 13 columns (and so can
// be read back) unless the frames 0, 1, ... are all there. The KITTI formats need frame_index.
void WriteTrajectory(const Trajectory& trajectory, TrajectoryFormat format, std::ostream& stream);
// The same into a file that appears whole or not at all. Throws InputError when not writable.
void WriteTrajectory(const Trajectory& trajectory, TrajectoryFormat format,
                     const std::filesystem::path& path);

}  // namespace lift_slam
