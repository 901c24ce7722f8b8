#include "lift_slam/simulation/sequence_folder.h"

#include <fmt/format.h>

#include <ostream>

#include "lift_slam/geometry/timestamp_text.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/image/image_file.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

std::string FrameName(int frame, const std::string& extension) {
  return fmt::format("{:06d}{}", frame, extension);
}

Trajectory MakeTrajectory(const std::vector<std::int64_t>& times_ns,
                          const std::vector<Rigid3d>& world_from_cam, const Rigid3d& new_from_old) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < times_ns.size(); ++i) {
    trajectory.push_back({static_cast<std::int64_t>(i), times_ns[i],
                          new_from_old * world_from_cam[i], PoseState::kOk});
  }
  return trajectory;
}

}  // namespace

SequenceFolder::SequenceFolder(fs::path root) : root_(std::move(root)) {}

fs::path SequenceFolder::Gray(int frame) const {
  return Sequence() / "image_0" / FrameName(frame, ".png");
}

fs::path SequenceFolder::Color(int frame) const {
  return Sequence() / "image_2" / FrameName(frame, ".png");
}

fs::path SequenceFolder::Depth(int frame, DepthFormat format) const {
  return Sequence() / "depth_0" / FrameName(frame, DepthExtension(format));
}

void SequenceFolder::Create(bool with_color, bool with_depth) const {
  CreateFolder(Sequence() / "image_0");
  if (with_color) CreateFolder(Sequence() / "image_2");
  if (with_depth) CreateFolder(Sequence() / "depth_0");
  CreateFolder(GroundTruth().parent_path());
}

void SequenceFolder::WriteMotion(const Camera& camera, const std::vector<std::int64_t>& times_ns,
                                 const std::vector<Rigid3d>& world_from_cam) const {
  std::string times;
  for (const std::int64_t time_ns : times_ns) times += FormatSeconds(time_ns) + "\n";
  WriteTextAtomically(Sequence() / "times.txt", times);
  if (!camera.HasDistortion()) {
    const PinholeIntrinsics& p = camera.pinhole;
    std::string calibration;
    for (int i = 0; i < 4; ++i) {  // the same camera, whichever folder is read
      calibration += fmt::format("P{}: {:.12e} 0 {:.12e} 0 0 {:.12e} {:.12e} 0 0 0 1 0\n", i, p.fx,
                                 p.cx, p.fy, p.cy);
    }
    WriteTextAtomically(Sequence() / "calib.txt", calibration);
  }
  WriteTrajectory(MakeTrajectory(times_ns, world_from_cam, Inverse(world_from_cam.front())),
                  TrajectoryFormat::kKitti, GroundTruth());
  WriteTrajectory(MakeTrajectory(times_ns, world_from_cam, Rigid3d()), TrajectoryFormat::kTum,
                  SceneTrajectory());
}

bool IsWholeImage(const fs::path& path) {
  if (!fs::is_regular_file(path) || fs::file_size(path) == 0) return false;
  const std::string bytes = ReadText(path);
  return IsCompleteImageFile({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

void WriteBytesAtomically(const fs::path& path, std::span<const std::uint8_t> bytes) {
  WriteFileAtomically(path, [&](std::ostream& stream) {
    stream.write(reinterpret_cast<const char*>(bytes.data()),
                 static_cast<std::streamsize>(bytes.size()));
  });
}

}  // namespace lift_slam
