#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/simulation/depth_file.h"

namespace lift_slam {

// Where the files of a rendered sequence are: the layout of KITTI odometry.
class SequenceFolder {
 public:
  explicit SequenceFolder(std::filesystem::path root);

  std::filesystem::path Sequence() const { return root_ / "sequences" / "00"; }
  std::filesystem::path Gray(int frame) const;   // image_0
  std::filesystem::path Color(int frame) const;  // image_2
  std::filesystem::path Depth(int frame, DepthFormat format) const;
  std::filesystem::path GroundTruth() const { return root_ / "poses" / "00.txt"; }
  std::filesystem::path SceneTrajectory() const { return root_ / "trajectory_scene.tum"; }
  std::filesystem::path Pairs() const { return root_ / "pairs.txt"; }
  std::filesystem::path Record() const { return root_ / "render.yaml"; }

  // Makes the folders that are needed. Throws InputError when it cannot.
  void Create(bool with_color, bool with_depth) const;

  // calib.txt (when the camera has no distortion, which it cannot hold), times.txt, the ground
  // truth relative to the first camera, as in the benchmark, and absolute in the scene frame.
  void WriteMotion(const Camera& camera, const std::vector<std::int64_t>& times_ns,
                   const std::vector<Rigid3d>& world_from_cam) const;

 private:
  std::filesystem::path root_;
};

// Whether an image file is there and whole.
bool IsWholeImage(const std::filesystem::path& path);

// Bytes to a file that appears whole or not at all.
void WriteBytesAtomically(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace lift_slam
