#pragma once

#include <string>

#include "lift_slam/simulation/camera_options.h"
#include "lift_slam/simulation/motion/drive_options.h"
#include "lift_slam/simulation/motion/hand_walk.h"
#include "lift_slam/simulation/motion/shaken_motion.h"
#include "lift_slam/simulation/pair_list.h"
#include "lift_slam/simulation/render_sequence.h"
#include "lift_slam/simulation/rendering/scene_renderer.h"
#include "lift_slam/simulation/scene/scene_loader.h"
#include "lift_slam/simulation/sensor_options.h"

namespace lift_slam {

// Who moves the camera. kAuto: recorded poses when a file is given, else a drive on scenes with a
// road and a walk in others.
enum class MotionKind { kAuto, kDrive, kWalk, kPoses };

// Poses of a file, in the scene's frame (camera x right, y down, z forward).
struct PoseFileOptions {
  std::string file;         // TUM, KITTI or EuRoC; empty: none
  std::string sha256;       // of the file; empty: any
  bool from_start = false;  // moved so that the first is where a drive or walk would begin
  double scale = 1.0;       // on the distances then
  void Visit(OptionVisitor& visitor);
};

// All that a rendered sequence depends on.
struct RenderOptions {
  std::string scene;            // TORCS track by name, or a file
  std::string scene_sha256;     // of its file; empty: any
  std::string program_version;  // that rendered it; filled in
  int seed = 1;                 // of everything random
  MotionKind motion = MotionKind::kAuto;
  std::string frames;  // "FIRST:LAST:STEP" of the motion's frames; empty: all
  PoseFileOptions poses;
  CameraOptions camera;
  DriveOptions drive;
  WalkOptions walk;
  ShakeOptions shake;
  SensorOptions sensor;
  RenderQuality quality;
  SceneLoaderOptions loader;
  SequenceOutputOptions outputs;
  PairOptions pair_limits;

  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

}  // namespace lift_slam
