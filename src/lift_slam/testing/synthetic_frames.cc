#include "lift_slam/testing/synthetic_frames.h"

#include <cstring>

namespace lift_slam {
namespace {

constexpr int kLevel = 2;  // of all features

}  // namespace

SyntheticFrames::SyntheticFrames(int num_points, double min_depth, double max_depth,
                                 std::uint64_t seed)
    : random_(seed) {
  const PinholeIntrinsics pinhole{400.0, 400.0, 320.0, 240.0, 640, 480};
  view_ = std::make_shared<ViewModel>(
      MakeViewModel(pinhole, {0.0, 640.0, 0.0, 480.0}, {8, 1.2, 1.0},
                    {{50.0F, 100.0F}, {50.0F, 100.0F}, {50.0F, 100.0F}}));
  for (int i = 0; i < num_points; ++i) {
    const double z = random_.Uniform(min_depth, max_depth);
    const double x = random_.Uniform(-0.5, 0.5), y = random_.Uniform(-0.4, 0.4);
    points_.push_back({z * x, z * y, z});
    descriptors_.push_back({random_.Bits(), random_.Bits(), random_.Bits(), random_.Bits()});
  }
}

Frame SyntheticFrames::MakeFrame(std::int64_t index, const Rigid3d& cam_from_world,
                                 double sigma_px) {
  FeatureSet features;
  features.descriptors = Descriptors({"orb", DescriptorMetric::kHamming, 256}, points_.size());
  std::vector<Eigen::Vector2f> undistorted;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Eigen::Vector2d pixel = view_->pinhole.Project(cam_from_world * points_[i]);
    pixel += sigma_px * Eigen::Vector2d(random_.Normal(), random_.Normal());
    undistorted.push_back(pixel.cast<float>());
    features.keypoints.push_back(
        {undistorted.back().x(), undistorted.back().y(), 0.1F, 1.0F, kLevel});
    std::array<std::uint64_t, 4> words = descriptors_[i];
    words[static_cast<std::size_t>(random_.UniformInt(0, 3))] ^= std::uint64_t{1}
                                                                 << random_.UniformInt(0, 63);
    std::memcpy(features.descriptors.mutable_row(i).data(), words.data(), sizeof words);
  }
  Frame frame(index, index * 100'000'000,
              std::make_shared<FrameFeatures>(std::move(features), std::move(undistorted), *view_));
  frame.cam_from_world = cam_from_world;
  return frame;
}

std::vector<MapPointId> SyntheticFrames::FillMap(const std::vector<Rigid3d>& cams_from_world,
                                                 Map& map) {
  std::vector<KeyFrameId> keyframes;
  for (const Rigid3d& pose : cams_from_world) {
    keyframes.push_back(
        map.AddKeyFrame(MakeFrame(static_cast<std::int64_t>(keyframes.size()), pose)));
  }
  std::vector<MapPointId> ids;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    ids.push_back(map.AddPoint(points_[i], keyframes.back()));
    for (const KeyFrameId keyframe : keyframes) {
      map.AddObservation(ids.back(), keyframe, static_cast<int>(i));
    }
    map.UpdateAppearance(ids.back());
  }
  return ids;
}

}  // namespace lift_slam
