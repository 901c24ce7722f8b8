#include "apps/online_trajectory_writer.h"

#include <fmt/format.h>

#include <sstream>
#include <string>
#include <utility>

#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

OnlineTrajectoryWriter::OnlineTrajectoryWriter(const std::filesystem::path& path)
    : path_(path), stream_(path, std::ios::binary | std::ios::trunc) {
  if (!stream_) throw InputError(fmt::format("{}: cannot create the file", path.string()));
}

void OnlineTrajectoryWriter::Append(const TrajectoryPose& pose) {
  if (pose.state != PoseState::kOk) return;
  std::ostringstream text;
  WriteTrajectory({pose}, TrajectoryFormat::kTum, text);
  const std::string lines = std::move(text).str();
  stream_ << (has_header_ ? lines.substr(lines.find('\n') + 1) : lines);
  stream_.flush();
  has_header_ = true;
  if (!stream_) {
    throw InputError(fmt::format("{}: cannot write the file (disk full?)", path_.string()));
  }
}

}  // namespace lift_slam
