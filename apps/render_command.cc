#include "apps/render_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <iostream>
#include <memory>

#include "apps/build_info.h"
#include "apps/exit_code.h"
#include "apps/progress_bar.h"
#include "apps/render_arguments.h"
#include "apps/render_scene.h"
#include "apps/stop_signal.h"
#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/image/image_threads.h"
#include "lift_slam/simulation/motion_plan.h"
#include "lift_slam/simulation/render_record.h"
#include "lift_slam/simulation/render_sequence.h"
#include "lift_slam/simulation/sequence_folder.h"
#include "lift_slam/simulation/sequence_video.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_writer.h"
#include "lift_slam/util/sha256.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

void CheckSceneFile(const RenderScene& scene, const RenderOptions& options) {
  if (options.scene_sha256.empty() || options.scene_sha256 == scene.sha256) return;
  throw InputError(fmt::format("{}: its SHA-256 is {}, but scene_sha256 asks for {}",
                               scene.file.string(), scene.sha256, options.scene_sha256));
}

// Fills in what was not asked for but belongs to the record.
void CompleteOptions(const RenderScene& scene, RenderOptions& options) {
  options.scene_sha256 = scene.sha256;
  options.program_version = kProgramVersion;
  if (!options.poses.file.empty()) options.poses.sha256 = Sha256Hex(ReadText(options.poses.file));
}

// A folder of something else would become part of the sequence.
void CheckOutputFolder(const fs::path& folder) {
  if (folder.empty()) throw InputError("--output is missing: expected a folder for the sequence");
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw InputError(fmt::format("{}: is a file, expected a folder", folder.string()));
  }
  if (fs::is_directory(folder) && !fs::is_empty(folder) &&
      !fs::exists(SequenceFolder(folder).Record())) {
    throw InputError(fmt::format(
        "{}: the folder is not empty and holds no rendered sequence (render.yaml); expected a new "
        "or empty one",
        folder.string()));
  }
}

SequenceRequest MakeRequest(const MotionPlan& plan, const RenderOptions& options,
                            const Eigen::AlignedBox3d& scene_box) {
  return {*plan.motion,
          plan.times_ns,
          options.camera.ToCamera(),
          options.sensor,
          options.outputs,
          options.pair_limits,
          RoomForCamera(scene_box),
          static_cast<std::uint64_t>(options.seed)};
}

ViewSourceFactory RendererFactory(const Scene& scene, const RenderOptions& options) {
  return [&scene, &options]() -> ViewSource {
    auto renderer =
        std::make_shared<SceneRenderer>(scene, options.camera.ToCamera(), options.quality);
    return [renderer](const Rigid3d& cam_from_world) { return renderer->Render(cam_from_world); };
  };
}

void PrintSummary(const RenderSummary& summary, const fs::path& output, double seconds) {
  const SequenceFolder folder(output);
  std::cout << fmt::format("sequence    {}\ntruth       {}\nscene frame {}\n",
                           folder.Sequence().string(), folder.GroundTruth().string(),
                           folder.SceneTrajectory().string());
  std::cout << fmt::format("frames      {}, {} of them rendered now ({:.2f} frames/s)\n",
                           summary.num_frames, summary.num_rendered,
                           summary.num_rendered / std::max(seconds, 1e-9));
}

// The rate of times at equal steps.
double EvenRateHz(const std::vector<std::int64_t>& times_ns, const fs::path& video) {
  if (times_ns.size() < 2) throw InputError(video.string() + ": a video needs two frames or more");
  const std::int64_t step = times_ns[1] - times_ns[0];
  for (std::size_t i = 2; i < times_ns.size(); ++i) {
    if (std::abs(times_ns[i] - times_ns[i - 1] - step) > 1000) {
      throw InputError(fmt::format(
          "{}: a video needs frames at a fixed rate, but frame {} comes {:.6f} s after the one "
          "before and frame 1 {:.6f} s",
          video.string(), i, static_cast<double>(times_ns[i] - times_ns[i - 1]) * 1e-9,
          static_cast<double>(step) * 1e-9));
    }
  }
  return std::round(1e15 / static_cast<double>(step)) * 1e-6;
}

// The video, and beside it the calibration, where `run` finds it, and the truth at the video's
// times.
bool WriteVideoFiles(const RenderArguments& arguments, const RenderOptions& options,
                     const MotionPlan& plan, const StopSignal& stop) {
  const SequenceFolder folder(arguments.output);
  const double rate_hz = EvenRateHz(plan.times_ns, arguments.video);
  std::vector<fs::path> images;
  for (int i = 0; i < static_cast<int>(plan.times_ns.size()); ++i) {
    images.push_back(options.outputs.color ? folder.Color(i) : folder.Gray(i));
  }
  if (!WriteVideo(arguments.video, images, rate_hz, [&] { return stop.Requested(); })) return false;
  Camera camera = options.camera.ToCamera();
  camera.frame_rate_hz = rate_hz;
  WriteCameraFile(fs::path(arguments.video).replace_extension(".yaml"), camera);
  WriteTextAtomically(fs::path(arguments.video).replace_extension(".tum"),
                      ReadText(folder.SceneTrajectory()));
  std::cout << fmt::format("video       {}, {:.2f} MB, with .yaml (camera) and .tum (truth)\n",
                           arguments.video.string(),
                           static_cast<double>(fs::file_size(arguments.video)) * 1e-6);
  return true;
}

void CheckVideo(const RenderArguments& arguments, const CameraOptions& camera,
                const MotionPlan& plan) {
  if (arguments.video.empty()) return;
  EvenRateHz(plan.times_ns, arguments.video);
  CheckVideoSize(arguments.video, camera.width, camera.height);
}

void StopHere(const StopSignal& stop, const RenderSummary& summary, const MotionPlan& plan) {
  std::cout << fmt::format("stopped by {} with {} of {} frames; the same command goes on\n",
                           stop.Name(), summary.num_frames, plan.times_ns.size());
  throw CLI::RuntimeError(kStopped);
}

void RenderAll(const RenderArguments& arguments, const RenderOptions& options,
               const RenderScene& scene, const MotionPlan& plan, const SequenceRequest& request) {
  const StopSignal stop;
  ProgressBar bar;
  Progress progress{0, static_cast<std::int64_t>(plan.times_ns.size()), "rendering", kNoMap, 0};
  const Clock::time_point start = Clock::now();
  RenderWork work;
  work.make_view_source = RendererFactory(scene.scene, options);
  work.num_threads = arguments.num_threads > 0 ? arguments.num_threads : NumHardwareThreads();
  work.stop = [&] { return stop.Requested(); };
  work.progress = [&](int frames_done) {
    progress.frames_done = frames_done;
    bar.Update(progress);
  };
  const RenderSummary summary = RenderSequence(arguments.output, request, work);
  progress.state = summary.stopped ? "stopped" : "rendered";
  progress.frames_done = summary.num_frames;
  bar.Finish(progress);
  const std::chrono::duration<double> seconds = Clock::now() - start;
  if (summary.stopped) StopHere(stop, summary, plan);
  PrintSummary(summary, arguments.output, seconds.count());
  if (!arguments.video.empty() && !WriteVideoFiles(arguments, options, plan, stop)) {
    StopHere(stop, summary, plan);
  }
}

void Render(const RenderArguments& arguments) {
  RenderOptions options = arguments.Options();
  if (arguments.list) {
    std::cout << TrackList(options.loader);
    return;
  }
  if (arguments.print_options) {
    std::cout << OptionsToYaml(MakeOptionRoot(options));
    return;
  }
  options.Check();
  CheckOutputFolder(arguments.output);
  DisableImageThreads();
  const RenderScene scene = LoadRenderScene(options.scene, options.loader);
  for (const std::string& warning : scene.warnings) std::cerr << "warning: " << warning << '\n';
  CheckSceneFile(scene, options);
  const MotionPlan plan = PlanMotion(options, scene.road, scene.no_road, SceneBox(scene.scene));
  CheckVideo(arguments, options.camera, plan);
  CompleteOptions(scene, options);
  std::cout << fmt::format("{}: {}, {} frames of {}x{}\n", options.scene, plan.description,
                           plan.times_ns.size(), options.camera.width, options.camera.height);
  const SequenceRequest request = MakeRequest(plan, options, SceneBox(scene.scene));
  FramePoses(request);  // a path that cannot be rendered leaves no file
  const SequenceFolder folder(arguments.output);
  folder.Create(options.outputs.color, options.outputs.depth);
  WriteOrCheckRenderRecord(folder.Record(), MakeOptionRoot(options));
  WriteCameraFile(folder.Sequence() / "camera.yaml", options.camera.ToCamera());
  RenderAll(arguments, options, scene, plan, request);
}

}  // namespace

void AddRenderCommand(CLI::App& app) {
  const auto arguments = std::make_shared<RenderArguments>();
  CLI::App* command = app.add_subcommand(
      "render", "Render a drive through a 3-D scene as a sequence with exact ground truth");
  arguments->AddTo(*command);
  command->footer(
      "Examples:\n"
      "  lift_slam render --list\n"
      "  lift_slam render dirt-3 --output runs/dirt-3 --laps 1 --extra 100\n"
      "  lift_slam render alpine-2 --output runs/dusk --size 620x188 --set quality.own_sun=true "
      "--set quality.sun_elevation_deg=8\n"
      "  lift_slam render room.glb --output runs/room --set shake.rotation_deg=0.5 --pairs\n"
      "  lift_slam render --config runs/dirt-3/render.yaml --output runs/again\n"
      "A run that was ended goes on with the same command. Needs the Debian package torcs-data for "
      "tracks.\n"
      "Exit codes: 0 done, 1 bad input, 130 ended by a signal before the last frame.");
  command->callback([arguments] { Render(*arguments); });
}

}  // namespace lift_slam
