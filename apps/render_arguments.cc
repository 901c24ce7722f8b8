#include "apps/render_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/util/config_file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"

namespace lift_slam {
namespace {

// "1241x376".
void ApplySize(const std::string& text, CameraOptions& camera) {
  const std::size_t cross = text.find('x');
  const auto number = [&](std::size_t begin, std::size_t end) -> std::int64_t {
    return ParseIndex(text.substr(begin, end - begin)).value_or(0);
  };
  const std::int64_t width = cross == std::string::npos ? 0 : number(0, cross);
  const std::int64_t height = cross == std::string::npos ? 0 : number(cross + 1, text.size());
  if (width < 1 || height < 1 || width > 16384 || height > 16384) {
    throw InputError(
        fmt::format("--size '{}': expected WIDTHxHEIGHT in pixels, each from 1 to 16384", text));
  }
  camera.ScaleTo(static_cast<int>(width), static_cast<int>(height));
}

void ApplyCameraFile(const std::filesystem::path& file, bool size_is_given, CameraOptions& camera) {
  const Camera calibration = ReadCameraFile(file);
  if ((calibration.pinhole.width < 1 || calibration.pinhole.height < 1) && !size_is_given) {
    throw InputError(
        fmt::format("{}: gives no image size; add --size WIDTHxHEIGHT", file.string()));
  }
  camera.Set(calibration);
}

}  // namespace

void RenderArguments::AddTo(CLI::App& command) {
  command.add_option(
      "SCENE", scene,
      "TORCS track by name (dirt-3, see --list), or a file: .acc .ac .gltf .glb .obj");
  command.add_option("--output", output, "Folder of the sequence; a part of it is gone on with");
  command.add_option("--laps", laps, "Rounds of the road; may be a fraction (default 1)");
  command.add_option("--extra", extra_m, "Metres driven after the laps (default 0)");
  command.add_option("--poses", poses_file,
                     "Poses of the camera in the scene instead (TUM, KITTI), a frame each");
  command.add_option("--camera", camera_file,
                     "Calibration file (default: KITTI's, 1241x376, f 718.856)");
  command.add_option("--size", size, "Image size, the view from left to right stays: WIDTHxHEIGHT");
  command.add_option("--rate", rate_hz, "Images a second (default 10)");
  command.add_option("--frames", frames, "Part of the frames, LAST included: FIRST:LAST:STEP");
  command.add_flag("--depth", depth, "Exact depth as well (depth_0, 256 a metre)");
  command.add_flag("--color", color, "Colour images as well (image_2)");
  command.add_flag("--pairs", pairs, "List of overlapping pairs as well (pairs.txt, with --depth)");
  command.add_option("--video", video, "The sequence as a video file too (.mp4)");
  command.add_option("--seed", seed, "Of everything random (default 1)");
  command.add_option("--jobs", num_threads, "Threads (default: as many as the machine has)")
      ->check(CLI::Range(1, 256));
  command.add_option("--config", config_file, "YAML file of options, such as another render.yaml")
      ->type_name("FILE");
  command.add_option("--set", overrides, "One option, over the file; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_flag("--list", list, "Print the known tracks and end");
  command.add_flag("--options", print_options, "Print all options with their comments and end");
}

RenderOptions RenderArguments::Options() const {
  RenderOptions options;
  const OptionRoot root = MakeOptionRoot(options);
  ConfigureOptions(config_file, {}, root);
  if (!camera_file.empty()) ApplyCameraFile(camera_file, !size.empty(), options.camera);
  if (!size.empty()) ApplySize(size, options.camera);
  ConfigureOptions({}, overrides, root);
  if (!scene.empty()) {
    if (scene != options.scene) options.scene_sha256.clear();
    options.scene = scene;
  }
  if (!poses_file.empty()) {
    options.poses.file = poses_file.string();
    options.poses.sha256.clear();
    options.motion = MotionKind::kPoses;
  }
  if (!frames.empty()) options.frames = frames;
  options.drive.laps = laps.value_or(options.drive.laps);
  options.drive.extra_m = extra_m.value_or(options.drive.extra_m);
  options.camera.rate_hz = rate_hz.value_or(options.camera.rate_hz);
  options.seed = seed.value_or(options.seed);
  options.outputs.depth |= depth || pairs;
  options.outputs.color |= color;
  options.outputs.pairs |= pairs;
  return options;
}

}  // namespace lift_slam
