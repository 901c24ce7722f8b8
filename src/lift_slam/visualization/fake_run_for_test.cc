#include "lift_slam/visualization/fake_run_for_test.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr std::int64_t kFrameNs = 100'000'000;

Rigid3d WorldFromCam(double x, double height, double z, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY())),
          Eigen::Vector3d(x, -height, z)};
}

Trajectory DriveThroughStreets(int num_frames) {
  Trajectory truth;
  double x = 0.0, z = 0.0, yaw = 0.0;
  for (int i = 0; i < num_frames; ++i) {
    const double height = 0.6 * std::sin(0.013 * i) + 0.004 * i;
    truth.push_back({i, i * kFrameNs, WorldFromCam(x, height, z, yaw), PoseState::kOk});
    const int phase = i % 130;  // straight on, then a quarter turn now left, now right
    if (phase >= 60 && phase < 90) yaw += ((i / 130) % 3 == 1 ? -1.0 : 1.0) * M_PI / 60.0;
    x += 0.9 * std::sin(yaw);
    z += 0.9 * std::cos(yaw);
  }
  return truth;
}

// Texture that looks a little like a street: dark road, bright sky, blocks of houses.
GrayImage StreetImage(int seed) {
  Random random(static_cast<std::uint64_t>(seed));
  cv::Mat image(188, 620, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int house = (x + 7 * seed) / 45 * 37 % 90;
      const bool road = y > 110 + std::abs(x - 310) / 6;
      const bool sky = y < 30 + house / 3 && std::abs(x - 310) < 250;
      const double base = road ? 85.0 : sky ? 225.0 : 70.0 + house;
      image.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(base + (sky ? 2.0 : 14.0) * random.Normal());
    }
  }
  return GrayImage(image);
}

AnnotatedFrame Annotate(const FrameRecord& frame, Random& random) {
  AnnotatedFrame annotated;
  annotated.frame_index = frame.frame_index;
  annotated.state = frame.state;
  annotated.image = StreetImage(static_cast<int>(frame.frame_index));
  for (int i = 0; i < 700; ++i) {
    annotated.marks.push_back({static_cast<float>(random.Uniform(5.0, 615.0)),
                               static_cast<float>(random.Uniform(20.0, 183.0)),
                               i < frame.num_inliers});
  }
  return annotated;
}

void AddPoints(const FakeRunOptions& options, int keyframe, Random& random, RunRecord& run) {
  const KeyFrameRecord& from = run.keyframes[static_cast<std::size_t>(keyframe)];
  for (int i = 0; i < options.points_per_keyframe; ++i) {
    const double side = random.Uniform() < 0.5 ? -1.0 : 1.0;
    const bool road = random.Uniform() < 0.15;
    const double lateral =
        road ? random.Uniform(-4.0, 4.0) : side * (7.0 + std::abs(random.Normal()));
    Eigen::Vector3d x(lateral, road ? 1.6 : random.Uniform(-6.0, 1.6), random.Uniform(4.0, 30.0));
    if (random.Uniform() < 0.01) x *= 20.0;  // the odd wild point
    PointRecord point;
    point.position = from.pose.world_from_cam * Eigen::Vector3d(x * options.map_units_per_metre);
    point.map_index = from.map_index;
    point.gray = static_cast<std::uint8_t>(random.UniformInt(20, 240));
    point.reprojection_error_px = static_cast<float>(random.Uniform(0.2, 1.5));
    for (int k = std::max(0, keyframe - random.UniformInt(1, 4)); k <= keyframe; ++k) {
      if (run.keyframes[static_cast<std::size_t>(k)].map_index != from.map_index) continue;
      point.observations.push_back({k, static_cast<float>(random.Uniform(0.0, 619.0)),
                                    static_cast<float>(random.Uniform(0.0, 187.0))});
    }
    run.points.push_back(std::move(point));
  }
}

TrackingState StateOf(const FakeRunOptions& options, int i) {
  if (options.num_maps == 0) return TrackingState::kInitializing;
  const int part = options.num_frames / options.num_maps;
  const int in_part = i % std::max(1, part);
  const int start = std::min(5, options.num_frames / 3);
  if (in_part < start) return TrackingState::kInitializing;
  const bool last_part = i / std::max(1, part) >= options.num_maps - 1;
  if (!last_part && in_part >= part - 8) return TrackingState::kLost;
  return TrackingState::kTracking;
}

void FillTimes(Random& random, FrameRecord& frame, RunRecord& run) {
  frame.extract_ms = 11.0 + std::abs(random.Normal());
  frame.track_ms = frame.world_from_cam ? 6.0 + 2.0 * std::abs(random.Normal()) : 1.5;
  frame.map_ms = frame.is_keyframe ? 45.0 + 8.0 * random.Normal() : 0.0;
  if (frame.frame_index == 5) frame.map_ms = 310.0;  // the first bundle adjustment
  run.stage_times_ms["extract"].push_back(frame.extract_ms);
  run.stage_times_ms["track"].push_back(frame.track_ms);
  if (frame.is_keyframe) run.stage_times_ms["local_mapping"].push_back(frame.map_ms);
}

void FillCounts(Random& random, FrameRecord& frame) {
  frame.num_features = 2000 - random.UniformInt(0, 40);
  if (frame.state == TrackingState::kTracking) {
    const double wave = 1.0 + 0.3 * std::sin(0.07 * static_cast<double>(frame.frame_index));
    frame.num_matches = static_cast<int>(330 * wave + 20 * random.Normal());
    frame.num_inliers = static_cast<int>(0.86 * frame.num_matches);
  } else {
    frame.num_matches = random.UniformInt(20, 300);
  }
}

FrameRefusal RefusalOf(TrackingState state, int i) {
  if (state == TrackingState::kLost) return FrameRefusal::kTooFewTracked;
  if (i == 0) return FrameRefusal::kFirstFrame;
  return i % 9 == 4 ? FrameRefusal::kTooFewMatches : FrameRefusal::kLowParallax;
}

}  // namespace

FakeRun MakeFakeRun(const FakeRunOptions& options) {
  FakeRun fake;
  fake.truth = DriveThroughStreets(options.num_frames);
  fake.truth_from_map = {1.0 / options.map_units_per_metre, Eigen::Quaterniond::Identity(),
                         Eigen::Vector3d::Zero()};
  RunRecord& run = fake.run;
  run.camera.pinhole = {360.0, 360.0, 309.5, 93.5, 620, 188};
  run.camera.frame_rate_hz = 10.0;
  Random random(5);
  TrackingState before = TrackingState::kInitializing;
  int map_index = -1;
  const Sim3d map_from_truth = Inverse(fake.truth_from_map);
  for (int i = 0; i < options.num_frames; ++i) {
    const TrajectoryPose& truth = fake.truth[static_cast<std::size_t>(i)];
    FrameRecord frame;
    frame.frame_index = i;
    frame.timestamp_ns = truth.timestamp_ns;
    frame.state = StateOf(options, i);
    TrajectoryPose pose = truth;
    pose.state = frame.state == TrackingState::kTracking ? PoseState::kOk
                 : map_index < 0                         ? PoseState::kNotInitialized
                                                         : PoseState::kLost;
    if (pose.state == PoseState::kOk) {
      if (before != TrackingState::kTracking) ++map_index;
      const double drift = 0.004 * i;
      pose.world_from_cam.translation +=
          Eigen::Vector3d(0.3 * std::sin(0.03 * i), 0.02 * drift, 0.2 * std::cos(0.02 * i) * drift);
      pose.world_from_cam = TransformWorld(pose.world_from_cam, map_from_truth);
      frame.world_from_cam = pose.world_from_cam;
      frame.map_index = map_index;
      frame.is_keyframe = i % 4 == 1;
    } else {
      frame.refusal = RefusalOf(frame.state, i);
    }
    ++run.refusals[static_cast<std::size_t>(frame.refusal)];
    FillCounts(random, frame);
    FillTimes(random, frame, run);
    if (frame.state == TrackingState::kLost && before == TrackingState::kTracking)
      ++run.lost_events;
    before = frame.state;
    run.final_trajectory.push_back(pose);
    run.online_trajectory.push_back(pose);
    if (frame.is_keyframe) run.keyframes.push_back({pose, map_index});
    run.frames.push_back(frame);
  }
  for (int k = 0; k < static_cast<int>(run.keyframes.size()); ++k)
    AddPoints(options, k, random, run);
  for (int a = 0; a < std::min(options.num_annotated, options.num_frames); ++a) {
    const int i = a * (options.num_frames - 1) / std::max(1, options.num_annotated - 1);
    run.annotated_frames.push_back(Annotate(run.frames[static_cast<std::size_t>(i)], random));
  }
  run.num_maps = options.num_maps;
  run.wall_time_s = 0.033 * options.num_frames;
  run.counters = {{"keyframe.enough_points", 61},
                  {"keyframe.too_soon", 30},
                  {"culling.points_seldom_found", 1201},
                  {"culling.keyframes_redundant", 7}};
  return fake;
}

ReportData MakeFakeReportData(const FakeRun& fake, bool with_truth) {
  ReportData data;
  data.sequence = "kitti/sequences/00 <made up>";
  const bool any_map = !fake.run.keyframes.empty();
  data.status = !any_map                ? ReportStatus::kFailed
                : fake.run.num_maps > 1 ? ReportStatus::kPartial
                                        : ReportStatus::kOk;
  data.status_label = !any_map ? "FAILED" : fake.run.num_maps > 1 ? "PARTIAL" : "OK";
  data.summary = any_map ? "The camera was tracked in 155 of 160 frames (97 %)."
                         : "No map could be started: no frame has a pose.";
  data.advice = any_map ? ""
                        : "In 121 of 160 frames: the camera has hardly moved since the reference "
                          "frame: a map needs sideways motion.";
  data.key_numbers = {
      {"Position error", with_truth ? "0.312" : "n/a", "m", "ATE RMSE after alignment"},
      {"Coverage", "96.9", "%", "155 of 160 frames"},
      {"Frames", "160", "", ""},
      {"Keyframes", fmt::format("{}", fake.run.keyframes.size()), "", ""},
      {"Map points", fmt::format("{}", fake.run.points.size()), "", ""},
      {"Speed", "30.3", "fps", "whole run"},
      {"Tracking", "18.9", "ms", "median per frame"},
      {"Peak memory", "148", "MB", ""}};
  data.tables = {{"Accuracy",
                  {{"ATE RMSE", "0.3121", "m", ""},
                   {"ATE median", "0.2711", "m", ""},
                   {"KITTI t_rel", "0.81", "%", "4 segments"}}},
                 {"Coverage",
                  {{"coverage", "0.969", "", "frames with a pose / frames"},
                   {"longest run", "155", "frames", ""},
                   {"maps", "1", "", ""}}}};
  if (with_truth) {
    data.ground_truth = fake.truth;
    data.ground_truth_view = TopView::kXZ;
    data.truth_from_map = fake.truth_from_map;
    double sum = 0.0;
    for (std::size_t i = 0; i < fake.truth.size(); ++i) {
      const TrajectoryPose& pose = fake.run.final_trajectory[i];
      if (pose.state != PoseState::kOk) continue;
      const double error = (fake.truth_from_map * pose.world_from_cam.translation -
                            fake.truth[i].world_from_cam.translation)
                               .norm();
      data.errors.push_back({pose.timestamp_ns, error});
      sum += error * error;
    }
    data.ate_rmse_m =
        std::sqrt(sum / std::max<double>(1.0, static_cast<double>(data.errors.size())));
  }
  data.provenance = {"",
                     {{"version", "0.1.0", "", ""},
                      {"revision", "754d561", "", ""},
                      {"processor", "AMD EPYC (2 threads)", "", ""},
                      {"calibration", "calib.txt (pinhole)", "", ""}}};
  data.configuration = "features:\n  kind: orb\n  max_features: 2000  # per image\nseed: 0\n";
  return data;
}

}  // namespace lift_slam
