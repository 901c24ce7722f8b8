#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/simulation/depth_file.h"
#include "lift_slam/simulation/motion/camera_motion.h"
#include "lift_slam/simulation/pair_list.h"
#include "lift_slam/simulation/sensor_options.h"
#include "lift_slam/simulation/view_source.h"

namespace lift_slam {

// What a rendered sequence consists of.
struct SequenceOutputOptions {
  bool color = false;  // image_2 as well
  bool depth = false;  // depth_0
  DepthFormat depth_format = DepthFormat::kPng16;
  bool pairs = false;  // pairs.txt; needs depth
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

// A sequence to render. What it refers to must live on until RenderSequence returns.
struct SequenceRequest {
  const CameraMotion& motion;
  std::vector<std::int64_t> times_ns;  // of the frames in the motion's time, increasing
  Camera camera;
  SensorOptions sensor;
  SequenceOutputOptions outputs;
  PairOptions pairs;
  Eigen::AlignedBox3d scene_box;  // where the camera may be
  std::uint64_t seed = 1;
};

// How it is rendered; nothing of it changes a byte of the result.
struct RenderWork {
  ViewSourceFactory make_view_source;
  int num_threads = 1;
  std::function<void(int frames_done)> progress;  // called in the calling thread; may be empty
  std::function<bool()> stop;                     // asked by all threads; may be empty
};

struct RenderSummary {
  int num_frames = 0;    // whole, in the end
  int num_rendered = 0;  // of them by this call; the others were there
  bool stopped = false;  // by RenderWork::stop
};

// Times of frames at a rate from 0 to the end of a motion.
std::vector<std::int64_t> FrameTimesNs(double duration_s, double rate_hz);

// Poses of the frames. Throws InputError naming frame and place when the camera leaves `scene_box`.
std::vector<Rigid3d> FramePoses(const SequenceRequest& request);

// Renders the frames that are not there yet below `root` (sequence_folder.h), ground truth first.
// Every file appears whole or not at all, so a run that was killed goes on where it was. Times
// start at 0 with the first frame. Throws InputError when a file cannot be written, and naming
// frame and place when the camera leaves the scene: outside `scene_box`, or nothing but sky in many
// frames in a row.
RenderSummary RenderSequence(const std::filesystem::path& root, const SequenceRequest& request,
                             const RenderWork& work);

}  // namespace lift_slam
