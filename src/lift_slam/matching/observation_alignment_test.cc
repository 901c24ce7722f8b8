#include "lift_slam/matching/observation_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "lift_slam/camera/camera.h"

namespace lift_slam {
namespace {

// A slanted textured plane, z = 10 + 0.5 x + 0.3 y, seen by cameras that look along z.
const Eigen::Vector3d kNormal(0.5, 0.3, -1.0);
constexpr double kOffset = 10.0;

double Texture(const Eigen::Vector3d& p) {
  return 120.0 + 45.0 * std::sin(9.0 * p.x() + 2.0 * p.y()) +
         40.0 * std::sin(-3.0 * p.x() + 8.0 * p.y() + 1.0);
}

Camera TestCamera(const Distortion& distortion) {
  Camera camera;
  camera.pinhole = {
      .fx = 300.0, .fy = 300.0, .cx = 159.5, .cy = 119.5, .width = 320, .height = 240};
  camera.distortion = distortion;
  return camera;
}

GrayImage Render(const Camera& camera, const Rigid3d& cam_from_world) {
  const Rigid3d world_from_cam = Inverse(cam_from_world);
  const Eigen::Vector3d eye = world_from_cam.translation;
  cv::Mat image(camera.pinhole.height, camera.pinhole.width, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const Eigen::Vector3d ray = world_from_cam.rotation * *camera.Unproject({x, y});
      const double t = (-kOffset - kNormal.dot(eye)) / kNormal.dot(ray);
      image.at<uchar>(y, x) = cv::saturate_cast<uchar>(Texture(eye + t * ray));
    }
  }
  return GrayImage(image);
}

// Keyframe 0 near the plane holds the anchors, and a frame or keyframe far from it the features to
// be aligned, detected with an error.
class ObservationAlignmentTest : public testing::Test {
 protected:
  void Build(const Distortion& distortion) {
    camera_ = TestCamera(distortion);
    ViewModel view = MakeViewModel(camera_.pinhole, {-40.0, 360.0, -40.0, 280.0}, {}, {});
    view.undistortion = std::make_shared<const UndistortionMap>(camera_);
    view_ = std::make_shared<const ViewModel>(std::move(view));
    map_ = std::make_unique<Map>(view_);
    for (int i = 0; i < 20; ++i) {
      const double x = -1.6 + 0.8 * (i % 5), y = -1.2 + 0.8 * (i / 5);
      points_.emplace_back(x, y, kOffset + 0.5 * x + 0.3 * y);
    }
    Frame first = MakeFrame({Eigen::Quaterniond::Identity(), {0.0, 0.0, -1.5}}, 0.0F);
    first_ = map_->AddKeyFrame(first);
    other_ = MakeFrame(
        {Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ())), {0.3, -0.1, 0.4}},
        0.7F);
    second_ = map_->AddKeyFrame(other_);
    for (int i = 0; i < 20; ++i) {
      const MapPointId id = map_->AddPoint(points_[static_cast<std::size_t>(i)], first_);
      map_->AddObservation(id, first_, i);
      map_->AddObservation(id, second_, i);
      other_.map_points[static_cast<std::size_t>(i)] = id;
    }
  }

  Frame MakeFrame(const Rigid3d& cam_from_world, float error_px) const {
    FeatureSet features;
    std::vector<Eigen::Vector2f> undistorted;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Eigen::Vector2d pixel = *camera_.Project(cam_from_world * points_[i]);
      const double angle = static_cast<double>(i);
      Keypoint keypoint;
      keypoint.x = static_cast<float>(pixel.x() + error_px * std::cos(angle));
      keypoint.y = static_cast<float>(pixel.y() + error_px * std::sin(angle));
      features.keypoints.push_back(keypoint);
      undistorted.push_back(
          camera_.Undistort(Eigen::Vector2d(keypoint.x, keypoint.y))->cast<float>());
    }
    features.descriptors =
        Descriptors({"test", DescriptorMetric::kHamming, 64}, features.keypoints.size());
    Frame frame(
        0, 0,
        std::make_shared<const FrameFeatures>(std::move(features), std::move(undistorted), *view_));
    frame.cam_from_world = cam_from_world;
    frame.pyramid =
        std::make_shared<const ImagePyramid>(BuildPyramid(Render(camera_, cam_from_world), {}));
    return frame;
  }

  double ErrorPx(int i, const Eigen::Vector2f& pixel) const {
    const Eigen::Vector3d in_cam = other_.cam_from_world * points_[static_cast<std::size_t>(i)];
    return (camera_.pinhole.Project(in_cam) - pixel.cast<double>()).norm();
  }

  void ExpectKeyFrameAligned() {
    for (int i = 0; i < 20; ++i) {
      const MapPointId id(i);
      AnchorPoint(id, first_, *map_);
      ASSERT_TRUE(map_->point(id).anchor);
      EXPECT_TRUE(AlignObservation(id, second_, *map_)) << i;
      EXPECT_LT(ErrorPx(i, map_->point(id).observations[1].pixel), 0.06) << i;
      EXPECT_TRUE(map_->point(id).observations[1].is_aligned);
    }
  }

  Camera camera_;
  std::shared_ptr<const ViewModel> view_;
  std::unique_ptr<Map> map_;
  std::vector<Eigen::Vector3d> points_;
  Frame other_;
  KeyFrameId first_, second_;
};

TEST_F(ObservationAlignmentTest, ObservationsOfAKeyFrameAreFoundExactly) {
  Build(NoDistortion{});
  EXPECT_GT(ErrorPx(3, map_->point(MapPointId(3)).observations[1].pixel), 0.6);
  ExpectKeyFrameAligned();
}

TEST_F(ObservationAlignmentTest, ADistortingLensIsTakenIntoAccount) {
  Build(RadialTangential{.k1 = -0.35, .k2 = 0.1, .p1 = 0.001, .p2 = -0.001});
  ExpectKeyFrameAligned();
}

TEST_F(ObservationAlignmentTest, MatchesOfAFrameAreAligned) {
  Build(NoDistortion{});
  for (int i = 0; i < 20; i += 2) AnchorPoint(MapPointId(i), first_, *map_);
  EXPECT_EQ(AlignMatches(*map_, other_), 10);
  for (int i = 0; i < 20; ++i) {
    const auto pixel = other_.AlignedPixel(i);
    EXPECT_EQ(pixel.has_value(), i % 2 == 0);
    if (pixel) {
      EXPECT_LT(ErrorPx(i, *pixel), 0.06);
    }
  }
  other_.ClearMatches();
  EXPECT_FALSE(other_.AlignedPixel(0));
}

TEST_F(ObservationAlignmentTest, AWrongMatchKeepsTheDetectedPixel) {
  Build(NoDistortion{});
  AnchorPoint(MapPointId(4), first_, *map_);
  MapPoint& point = map_->point(MapPointId(4));
  std::ranges::reverse(point.anchor->patch.gray);  // another texture
  map_->SetAlignedPixel(point.id, second_, Eigen::Vector2f(1.0F, 1.0F));
  EXPECT_FALSE(AlignObservation(point.id, second_, *map_));
  EXPECT_EQ(point.observations[1].pixel, other_.features->undistorted(4));
  EXPECT_FALSE(point.observations[1].is_aligned);
}

TEST_F(ObservationAlignmentTest, NothingHappensWithoutAnImage) {
  Build(NoDistortion{});
  EXPECT_FALSE(AlignObservation(MapPointId(0), second_, *map_));  // no anchor yet
  Frame blind = other_;
  blind.pyramid.reset();
  EXPECT_EQ(AlignMatches(*map_, blind), 0);
  EXPECT_FALSE(blind.AlignedPixel(0));
}

}  // namespace
}  // namespace lift_slam
