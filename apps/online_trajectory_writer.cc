#include "apps/online_trajectory_writer.h"

#include <fmt/format.h>

#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

OnlineTrajectoryWriter::OnlineTrajectoryWriter(const std::filesystem::path& path)
    : path_(path), stream_(path, std::ios::binary | std::ios::trunc) {
  if (!stream_) throw InputError(fmt::format("{}: cannot create the file", path.string()));
}

void OnlineTrajectoryWriter::Append(const TrajectoryPose& pose) {
  if (pose.state != PoseState::kOk) return;
  WriteTrajectory({pose}, TrajectoryFormat::kTum, stream_);
  stream_.flush();
  if (!stream_) {
    throw InputError(fmt::format("{}: cannot write the file (disk full?)", path_.string()));
  }
}

}  // namespace lift_slam
