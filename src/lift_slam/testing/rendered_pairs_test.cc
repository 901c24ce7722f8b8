// The whole chain on rendered images: features found by OpenCV, matched, reconstructed, compared
// with the path.
#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/features2d.hpp>

#include "lift_slam/geometry/triangulation.h"
#include "lift_slam/geometry/two_view_reconstruction.h"
#include "lift_slam/testing/synthetic_sequence.h"

namespace lift_slam {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Features {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
};

Features Extract(const GrayImage& image) {
  Features features;
  cv::ORB::create(1500)->detectAndCompute(image.mat(), {}, features.keypoints,
                                          features.descriptors);
  return features;
}

std::vector<TwoViewMatch> Match(const SyntheticSequence& sequence, int first, int second) {
  const Features in1 = Extract(sequence.Render(first)), in2 = Extract(sequence.Render(second));
  std::vector<std::vector<cv::DMatch>> pairs;
  cv::BFMatcher(cv::NORM_HAMMING).knnMatch(in1.descriptors, in2.descriptors, pairs, 2);
  const auto normalized = [&](const cv::Point2f& pixel) {
    return Eigen::Vector2d(sequence.camera().pinhole.Unproject({pixel.x, pixel.y}).head<2>());
  };
  std::vector<TwoViewMatch> matches;
  for (const auto& pair : pairs) {
    if (pair.size() < 2 || pair[0].distance > 0.8F * pair[1].distance) continue;
    const auto& keypoint1 = in1.keypoints[static_cast<std::size_t>(pair[0].queryIdx)];
    const auto& keypoint2 = in2.keypoints[static_cast<std::size_t>(pair[0].trainIdx)];
    matches.push_back(
        {normalized(keypoint1.pt), normalized(keypoint2.pt), std::pow(1.2, keypoint1.octave)});
  }
  return matches;
}

TwoViewReconstruction Reconstruct(const SyntheticSequence& sequence, int first, int second) {
  const auto matches = Match(sequence, first, second);
  EXPECT_GT(matches.size(), 150U);
  return ReconstructTwoViews(matches, sequence.camera().pinhole.fx, {}, 1);
}

SyntheticSequenceOptions OptionsOf(SyntheticPath path, double frame_rate_hz) {
  SyntheticSequenceOptions options;
  options.path = path;
  options.frame_rate_hz = frame_rate_hz;
  return options;
}

void ExpectTruePose(const SyntheticSequence& sequence, int first, int second) {
  const TwoViewReconstruction result = Reconstruct(sequence, first, second);
  EXPECT_EQ(result.status, TwoViewStatus::kSuccess) << Name(result.status);
  const Rigid3d truth = Inverse(sequence.WorldFromCam(second)) * sequence.WorldFromCam(first);
  const Rigid3d& found = result.cam2_from_cam1;
  EXPECT_LT(RotationAngle(truth.rotation * found.rotation.conjugate()) * kDegrees, 0.4);
  EXPECT_LT(AngleBetween(truth.translation, found.translation) * kDegrees, 7.0);
  EXPECT_GT(result.num_inliers, 0.6 * static_cast<double>(result.is_inlier.size()));
}

TEST(RenderedPairs, StreetDriveGivesTheTruePose) {
  const SyntheticSequence sequence(OptionsOf(SyntheticPath::kStreetDrive, 10.0));
  for (const int first : {0, 100, 300}) ExpectTruePose(sequence, first, first + 2);
}

TEST(RenderedPairs, RoomSwayAndLoopGiveTheTruePose) {
  const SyntheticSequence sway(OptionsOf(SyntheticPath::kRoomSway, 30.0));
  ExpectTruePose(sway, 0, 12);
  ExpectTruePose(sway, 100, 112);
  const SyntheticSequence loop(OptionsOf(SyntheticPath::kRoomLoop, 30.0));
  ExpectTruePose(loop, 0, 8);
  ExpectTruePose(loop, 300, 308);
}

TEST(RenderedPairs, RotationAndStandstillAreRefused) {
  const SyntheticSequence rotation(OptionsOf(SyntheticPath::kRoomRotation, 30.0));
  for (const int step : {5, 10, 20}) {
    EXPECT_EQ(Reconstruct(rotation, 0, step).status, TwoViewStatus::kPureRotation);
  }
  const SyntheticSequence still(OptionsOf(SyntheticPath::kRoomStill, 30.0));
  EXPECT_EQ(Reconstruct(still, 0, 20).status, TwoViewStatus::kLowParallax);
}

}  // namespace
}  // namespace lift_slam
