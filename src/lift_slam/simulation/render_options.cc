#include "lift_slam/simulation/render_options.h"

#include <fmt/format.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr std::string_view kMotionNames[] = {"auto", "drive", "walk", "poses"};

}  // namespace

void PoseFileOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("file", file, "poses of the camera in the scene: TUM, KITTI or EuRoC");
  visitor.Field("sha256", sha256, "of that file; empty: any");
  visitor.Field("from_start", from_start,
                "moved so that the first is where a drive or walk would begin");
  visitor.Field("scale", scale, "on the distances, with from_start");
}

void RenderOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("scene", scene, "TORCS track by name, or a file (.acc, .ac, .gltf, .glb, .obj)");
  visitor.Field("scene_sha256", scene_sha256, "of the scene's file; empty: any");
  visitor.Field("program_version", program_version, "that rendered it; filled in");
  visitor.Field("seed", seed, "of everything random; the same seed gives the same pixels");
  visitor.Field("motion", motion, kMotionNames,
                "auto: poses when a file is given, else drive with a road, else walk");
  visitor.Field("frames", frames, "part of the motion's frames, FIRST:LAST:STEP; empty: all");
  visitor.Group("poses", poses, "a path from a file");
  visitor.Group("camera", camera, "calibration and rate");
  visitor.Group("drive", drive, "a car on the road");
  visitor.Group("walk", walk, "a camera in the hand around a room");
  visitor.Group("shake", shake, "trembling on top of any motion");
  visitor.Group("sensor", sensor, "effects, each off by default");
  visitor.Group("quality", quality, "how pixels are made");
  visitor.Group("loader", loader, "how the scene is read");
  visitor.Group("outputs", outputs, "files beside the grey images");
  visitor.Group("pair_limits", pair_limits, "which pairs of frames pairs.txt lists");
}

void RenderOptions::Check() const {
  if (scene.empty()) throw InputError("there is no scene to render, expected a track or a file");
  if (seed < 0) throw InputError(fmt::format("seed is {}, expected 0 or more", seed));
  if (!(poses.scale > 0.0)) {
    throw InputError(fmt::format("poses.scale is {}, expected more than 0", poses.scale));
  }
  camera.Check();
  drive.Check();
  walk.Check();
  shake.Check();
  sensor.Check();
  quality.Check();
  outputs.Check();
  pair_limits.Check();
}

}  // namespace lift_slam
