// Two-view reconstruction on pairs of real images, against ground truth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/features2d.hpp>
#include <opencv2/imgcodecs.hpp>

#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/geometry/two_view_reconstruction.h"
#include "lift_slam/testing/real_data.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Intrinsics {
  double focal, cx, cy;
};

struct Features {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
};

Features Extract(const fs::path& path) {
  Features features;
  const cv::Mat image = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
  cv::SIFT::create(1500)->detectAndCompute(image, {}, features.keypoints, features.descriptors);
  return features;
}

TwoViewReconstruction Reconstruct(const fs::path& image1, const fs::path& image2,
                                  const Intrinsics& camera) {
  const Features in1 = Extract(image1), in2 = Extract(image2);
  std::vector<std::vector<cv::DMatch>> pairs;
  cv::BFMatcher(cv::NORM_L2).knnMatch(in1.descriptors, in2.descriptors, pairs, 2);
  const auto normalized = [&](const cv::Point2f& pixel) {
    return Eigen::Vector2d((pixel.x - camera.cx) / camera.focal,
                           (pixel.y - camera.cy) / camera.focal);
  };
  std::vector<TwoViewMatch> matches;
  for (const auto& pair : pairs) {
    if (pair.size() < 2 || pair[0].distance > 0.8F * pair[1].distance) continue;
    const cv::KeyPoint& keypoint1 = in1.keypoints[static_cast<std::size_t>(pair[0].queryIdx)];
    const cv::KeyPoint& keypoint2 = in2.keypoints[static_cast<std::size_t>(pair[0].trainIdx)];
    matches.push_back({normalized(keypoint1.pt), normalized(keypoint2.pt),
                       std::max(0.5, 0.17 * static_cast<double>(keypoint1.size))});
  }
  return ReconstructTwoViews(matches, camera.focal, {}, 1);
}

fs::path Numbered(const fs::path& folder, int index, int digits) {
  return folder / fmt::format("{:0{}d}.png", index, digits);
}

class RealPairs : public testing::Test {
 protected:
  void SetUp() override {
    data_ = RealDataFolder();
    if (data_.empty()) GTEST_SKIP() << "no real data: set LIFT_SLAM_DATA";
  }

  void ExpectKittiPair(const std::string& sequence, int first, int step, const Intrinsics& camera) {
    const Trajectory poses =
        ReadTrajectory(data_ / "kitti/poses_cut" / (sequence + ".txt")).trajectory;
    const fs::path images = data_ / "kitti/sequences" / sequence / "image_0";
    const auto result =
        Reconstruct(Numbered(images, first, 6), Numbered(images, first + step, 6), camera);
    SCOPED_TRACE(fmt::format("sequence {}, frames {} and {}", sequence, first, first + step));
    EXPECT_EQ(result.status, TwoViewStatus::kSuccess) << Name(result.status);
    const auto world_from_cam = [&](int frame) -> const Rigid3d& {
      return poses.at(static_cast<std::size_t>(frame)).world_from_cam;
    };
    const Rigid3d truth = Inverse(world_from_cam(first + step)) * world_from_cam(first);
    const Rigid3d& found = result.cam2_from_cam1;
    EXPECT_LT(RotationAngle(truth.rotation * found.rotation.conjugate()) * kDegrees, 0.5);
    EXPECT_LT(AngleBetween(truth.translation, found.translation) * kDegrees, 4.0);
  }

  fs::path data_;
};

TEST_F(RealPairs, KittiForwardMotionFrom1To3FramesApart) {
  for (const int first : {0, 60, 130}) {
    ExpectKittiPair("00", first, 2, {718.856, 607.1928, 185.2157});
  }
  for (const int step : {1, 2, 3}) ExpectKittiPair("06", 10, step, {707.0912, 601.8873, 183.1104});
}

TEST_F(RealPairs, MovingCarAndCyclistDoNotMislead) {
  const fs::path images = data_ / "kitti_raw/2011_09_26/2011_09_26_drive_0005_sync/image_00/data";
  const auto result =
      Reconstruct(Numbered(images, 0, 10), Numbered(images, 3, 10), {721.5377, 609.5593, 172.854});
  EXPECT_EQ(result.status, TwoViewStatus::kSuccess) << Name(result.status);
  const Eigen::Vector3d forward(0.0, 0.0, -1.0);  // the car drives along its optical axis
  EXPECT_LT(AngleBetween(forward, result.cam2_from_cam1.translation) * kDegrees, 6.0);
}

TEST_F(RealPairs, StillVehicleIsRefused) {
  std::vector<fs::path> images;
  for (const auto& entry :
       fs::directory_iterator(data_ / "euroc/V1_01_easy_static30/mav0/cam0/data")) {
    if (entry.path().extension() == ".png") images.push_back(entry.path());
  }
  std::sort(images.begin(), images.end());
  ASSERT_GE(images.size(), 30U);
  for (const std::size_t second : {1U, 10U, 29U}) {
    const auto result = Reconstruct(images[0], images[second], {458.0, 367.215, 248.375});
    EXPECT_EQ(result.status, TwoViewStatus::kLowParallax) << Name(result.status);
  }
}

}  // namespace
}  // namespace lift_slam
