#include "lift_slam/simulation/motion_plan.h"

#include <fmt/format.h>

#include <array>

#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/simulation/motion/recorded_motion.h"
#include "lift_slam/simulation/motion/road_drive.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/number_text.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

struct FrameRange {
  std::int64_t first = 0, last = -1, step = 1;  // last -1: the end
};

FrameRange ParseRange(const std::string& text) {
  FrameRange range;
  const std::array<std::int64_t*, 3> parts = {&range.first, &range.last, &range.step};
  std::size_t begin = 0;
  for (std::size_t i = 0; begin <= text.size(); ++i) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const auto value = ParseIndex(part);
    if (i >= parts.size() || (!value && !part.empty())) {
      throw InputError(
          fmt::format("frames '{}': expected FIRST:LAST:STEP, whole numbers from 0 on", text));
    }
    if (value) *parts[i] = *value;
    begin = end + 1;
  }
  if (range.step < 1 || (range.last >= 0 && range.last < range.first)) {
    throw InputError(fmt::format(
        "frames '{}': expected FIRST:LAST:STEP with FIRST <= LAST and a step of at least 1", text));
  }
  return range;
}

void SelectFrames(const std::string& text, std::vector<std::int64_t>& times_ns) {
  const FrameRange range = ParseRange(text);
  const auto size = static_cast<std::int64_t>(times_ns.size());
  std::vector<std::int64_t> selected;
  const std::int64_t last = range.last < 0 ? size - 1 : std::min(range.last, size - 1);
  for (std::int64_t i = range.first; i <= last; i += range.step) {
    selected.push_back(times_ns[static_cast<std::size_t>(i)]);
  }
  if (selected.empty()) {
    throw InputError(
        fmt::format("frames '{}': selects none of the motion's {} frames", text, size));
  }
  times_ns = std::move(selected);
}

MotionPlan PlanDrive(const RenderOptions& options, const std::optional<Road>& road,
                     const std::string& no_road) {
  if (!road) {
    throw InputError(fmt::format("{}: there is no road to drive on: {}", options.scene, no_road));
  }
  auto drive =
      std::make_shared<RoadDrive>(*road, options.drive, static_cast<std::uint64_t>(options.seed));
  MotionPlan plan;
  plan.description = fmt::format("drive of {:.0f} m in {:.1f} s on a loop of {:.0f} m",
                                 drive->LengthM(), drive->DurationS(), drive->path().LengthM());
  plan.motion = std::move(drive);
  return plan;
}

MotionPlan PlanWalk(const RenderOptions& options, const Eigen::AlignedBox3d& scene_box) {
  MotionPlan plan;
  plan.motion =
      std::make_shared<HandWalk>(scene_box, options.walk, static_cast<std::uint64_t>(options.seed));
  plan.description = fmt::format("walk of {:.1f} s", plan.motion->DurationS());
  return plan;
}

MotionPlan PlanOwnMotion(const RenderOptions& options, const std::optional<Road>& road,
                         const std::string& no_road, const Eigen::AlignedBox3d& scene_box) {
  const bool walks =
      options.motion == MotionKind::kWalk || (options.motion != MotionKind::kDrive && !road);
  return walks ? PlanWalk(options, scene_box) : PlanDrive(options, road, no_road);
}

Trajectory ReadPoses(const PoseFileOptions& options) {
  if (options.file.empty()) {
    throw InputError("motion is 'poses', but poses.file names no file of poses");
  }
  if (!options.sha256.empty() && Sha256Hex(ReadText(options.file)) != options.sha256) {
    throw InputError(fmt::format("{}: its SHA-256 is not {}, which poses.sha256 asks for",
                                 options.file, options.sha256));
  }
  Trajectory poses = ReadTrajectory(options.file).trajectory;
  if (poses.empty()) throw InputError(fmt::format("{}: holds no pose", options.file));
  return poses;
}

}  // namespace

MotionPlan PlanMotion(const RenderOptions& options, const std::optional<Road>& road,
                      const std::string& no_road, const Eigen::AlignedBox3d& scene_box) {
  const bool is_recorded = options.motion == MotionKind::kPoses ||
                           (options.motion == MotionKind::kAuto && !options.poses.file.empty());
  MotionPlan plan;
  if (is_recorded) {
    Trajectory poses = ReadPoses(options.poses);
    if (options.poses.from_start) {
      const MotionPlan own = PlanOwnMotion(options, road, no_road, scene_box);
      poses = MovedToStart(poses, own.motion->WorldFromCam(0.0), options.poses.scale);
    }
    const auto recorded = std::make_shared<RecordedMotion>(poses);
    plan.times_ns = recorded->TimesNs();
    plan.motion = recorded;
    plan.description = fmt::format("{} poses of {}", poses.size(), options.poses.file);
  } else {
    plan = PlanOwnMotion(options, road, no_road, scene_box);
    plan.times_ns = FrameTimesNs(plan.motion->DurationS(), options.camera.rate_hz);
  }
  if (!options.shake.IsOff()) {
    plan.motion = std::make_shared<ShakenMotion>(plan.motion, options.shake,
                                                 static_cast<std::uint64_t>(options.seed));
  }
  if (!options.frames.empty()) SelectFrames(options.frames, plan.times_ns);
  return plan;
}

Eigen::AlignedBox3d SceneBox(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const SceneMesh& mesh : scene.meshes) {
    for (const SceneVertex& vertex : mesh.vertices) box.extend(vertex.position.cast<double>());
  }
  return box;
}

Eigen::AlignedBox3d RoomForCamera(const Eigen::AlignedBox3d& scene_box) {
  const double margin = std::max(2.0, 0.02 * scene_box.sizes().norm());
  return {scene_box.min() - Eigen::Vector3d::Constant(margin),
          scene_box.max() + Eigen::Vector3d::Constant(margin)};
}

}  // namespace lift_slam
