#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "lift_slam/camera/camera.h"
#include "lift_slam/image/image.h"
#include "lift_slam/testing/camera_path.h"
#include "lift_slam/testing/renderer.h"
#include "lift_slam/testing/textured_world.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// 640 x 480 pixels, 500 px focal length, no distortion.
Camera SyntheticCamera();

struct SyntheticSequenceOptions {
  SyntheticPath path = SyntheticPath::kRoomSway;
  Camera camera = SyntheticCamera();
  int num_frames = 100;
  double frame_rate_hz = 30.0;   // 10 is usual for kStreetDrive
  double noise_gray = 1.5;       // standard deviation of the pixel noise
  double exposure_change = 0.0;  // share by which the exposure swings slowly up and down
  std::uint64_t seed = 1;        // textures, layout and noise
};

// A rendered image sequence with exact poses. Frames are rendered when asked for, in any order,
// always the same bytes. Throws InputError when the camera is not usable.
class SyntheticSequence {
 public:
  explicit SyntheticSequence(const SyntheticSequenceOptions& options);

  int size() const { return options_.num_frames; }
  const Camera& camera() const { return options_.camera; }
  std::int64_t TimestampNs(int frame) const;  // frame 0 is at 0
  Rigid3d WorldFromCam(int frame) const;      // world: x right, y down, z forward, metres
  GrayImage Render(int frame) const;

 private:
  double TimeS(int frame) const;

  SyntheticSequenceOptions options_;
  TexturedWorld world_;
  Renderer renderer_;
};

enum class SequenceLayout {
  kKittiOdometry,  // sequences/00/{image_0/NNNNNN.png, calib.txt, times.txt} and poses/00.txt
  kTumRgbd,        // rgb/, rgb.txt, groundtruth.txt, camera.yaml
  kEuroc,          // mav0/cam0/{data/, data.csv, sensor.yaml}, state_groundtruth_estimate0/
};

struct WrittenSequence {
  std::filesystem::path folder;        // what to give to a reader
  std::filesystem::path ground_truth;  // the pose file
};

// Renders and stores a sequence with its ground truth below `root` (created when missing).
//   KITTI: poses relative to the first camera, as in the benchmark; no distortion allowed.
//   TUM: poses of the camera in the world.
//   EuRoC: poses of a body (IMU) 7 cm off the camera and turned by 90 degrees: T_BS in sensor.yaml;
//   distortion none or radial-tangential without k3.
// `image_written`, when given, hears of the number of images written so far.
// Throws InputError when a file cannot be written or the layout cannot hold the camera's model.
WrittenSequence WriteSyntheticSequence(const std::filesystem::path& root, SequenceLayout layout,
                                       const SyntheticSequenceOptions& options,
                                       const std::function<void(int)>& image_written = {});

}  // namespace lift_slam
