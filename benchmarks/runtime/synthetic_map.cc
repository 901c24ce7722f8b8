#include "benchmarks/runtime/synthetic_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kExtraCameras = 3;  // frames after the keyframes
constexpr ScaleLevels kLevels = {8, 1.2, 1.0};
constexpr ThresholdRange kThresholds = {{50.0F, 100.0F}, {50.0F, 100.0F}, {50.0F, 100.0F}};

std::vector<Rigid3d> CameraPath(int num_cameras, double step_m) {
  std::vector<Rigid3d> cams_from_world;
  for (int i = 0; i < num_cameras; ++i) {
    const Eigen::Vector3d center(0.3 * step_m * i, 0.0, step_m * i);
    cams_from_world.push_back({Eigen::Quaterniond::Identity(), -center});
  }
  return cams_from_world;
}

// The level on which a corner of one size in the world is found: finer from farther away.
int LevelAt(double distance, double distance_at_level_0) {
  const double level = std::log(distance_at_level_0 / distance) / std::log(kLevels.scale_factor);
  return std::clamp(static_cast<int>(std::lround(level)), 0, kLevels.num_levels - 1);
}

}  // namespace

SyntheticMap::SyntheticMap(const SyntheticMapOptions& options)
    : options_(options),
      scene_(MakeSyntheticScene(CameraPath(options.num_keyframes + kExtraCameras, options.step_m),
                                {.num_points = options.num_points, .seed = options.seed})) {
  const PinholeIntrinsics& pinhole = scene_.pinhole;
  view_ = std::make_shared<const ViewModel>(MakeViewModel(
      pinhole, {0.0, pinhole.width - 1.0, 0.0, pinhole.height - 1.0}, kLevels, kThresholds));
  num_mapped_ = static_cast<int>(options.mapped_share * options.num_points);
  Random random(options.seed);
  for (int i = 0; i < options.num_points; ++i) {
    descriptors_.push_back({random.Bits(), random.Bits(), random.Bits(), random.Bits()});
  }
  for (std::size_t i = 0; i < scene_.cams_from_world.size(); ++i) {
    features_.push_back(std::make_shared<const FrameFeatures>(MakeFeatures(static_cast<int>(i))));
  }
}

FrameFeatures SyntheticMap::MakeFeatures(int camera) const {
  Random random(options_.seed + 1 + static_cast<std::uint64_t>(camera));
  const auto& observations = scene_.observations[static_cast<std::size_t>(camera)];
  const Rigid3d& cam_from_world = scene_.cams_from_world[static_cast<std::size_t>(camera)];
  FeatureSet features;
  features.descriptors = Descriptors({"orb", DescriptorMetric::kHamming, 256}, observations.size());
  std::vector<Eigen::Vector2f> undistorted;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const auto point = static_cast<std::size_t>(observations[i].point);
    const double distance = (cam_from_world * scene_.points[point]).norm();
    const double at_level_0 =
        scene_.points[point].norm() * (1.0 + 0.2 * static_cast<double>(point % 4));
    const Eigen::Vector2f pixel = observations[i].pixel.cast<float>();
    features.keypoints.push_back({pixel.x(), pixel.y(), 0.1F, 1.0F, LevelAt(distance, at_level_0)});
    undistorted.push_back(pixel);
    std::array<std::uint64_t, 4> words = descriptors_[point];
    for (int flip = 0; flip < options_.flipped_bits / 2; ++flip) {
      words[static_cast<std::size_t>(random.UniformInt(0, 3))] ^= std::uint64_t{1}
                                                                  << random.UniformInt(0, 63);
    }
    std::memcpy(features.descriptors.mutable_row(i).data(), words.data(), sizeof(words));
  }
  return FrameFeatures(std::move(features), std::move(undistorted), *view_);
}

Frame SyntheticMap::MakeFrame(int i) const {
  const auto camera = static_cast<std::size_t>(i);
  Frame frame(i, std::int64_t{100'000'000} * i, features_.at(camera));
  frame.cam_from_world = scene_.cams_from_world[camera];
  return frame;
}

Frame SyntheticMap::MakeTrackedFrame(int i) const {
  Frame frame = MakeFrame(i);
  const auto& observations = scene_.observations[static_cast<std::size_t>(i)];
  for (std::size_t feature = 0; feature < observations.size(); ++feature) {
    const int point = observations[feature].point;
    if (IsMapped(point)) frame.map_points[feature] = MapPointId(point);
  }
  return frame;
}

std::unique_ptr<Map> SyntheticMap::MakeMap() const {
  auto map = std::make_unique<Map>(view_);
  for (int i = 0; i < options_.num_keyframes; ++i) map->AddKeyFrame(MakeFrame(i));
  for (int i = 0; i < num_mapped_; ++i) {
    const MapPointId id = map->AddPoint(scene_.points[static_cast<std::size_t>(i)], KeyFrameId(0));
    LIFT_SLAM_CHECK(id == MapPointId(i), "map point {} instead of {}", id.value, i);
  }
  for (int i = 0; i < options_.num_keyframes; ++i) {
    const Frame tracked = MakeTrackedFrame(i);
    for (std::size_t feature = 0; feature < tracked.map_points.size(); ++feature) {
      const MapPointId point = tracked.map_points[feature];
      if (point.valid()) {
        map->AddObservation(point, KeyFrameId(i), static_cast<int>(feature));
      }
    }
  }
  for (int i = 0; i < num_mapped_; ++i) {
    const MapPointId id(i);
    if (map->point(id).observations.size() < 2) {
      map->ErasePoint(id);
    } else {
      map->UpdateAppearance(id);
    }
  }
  return map;
}

}  // namespace lift_slam
