#include <gtest/gtest.h>

#include <functional>
#include <opencv2/core.hpp>

#include "lift_slam/local_mapping/culling.h"
#include "lift_slam/local_mapping/fusion.h"
#include "lift_slam/local_mapping/local_mapper.h"
#include "lift_slam/local_mapping/point_creation.h"
#include "lift_slam/local_mapping/repetition_check.h"
#include "lift_slam/testing/synthetic_frames.h"

namespace lift_slam {
namespace {

constexpr int kPoints = 200;

Rigid3d CameraAt(double x) { return {Eigen::Quaterniond::Identity(), {-x, 0.0, -0.02}}; }

class LocalMappingTest : public testing::Test {
 protected:
  // Two keyframes that see the first half of the points in the map, so that they are covisible.
  void FillHalf() {
    first_ = map_.AddKeyFrame(scene_.MakeFrame(0, CameraAt(0.0)));
    second_ = map_.AddKeyFrame(scene_.MakeFrame(1, CameraAt(0.4)));
    for (int i = 0; i < kPoints / 2; ++i) {
      const MapPointId id = map_.AddPoint(scene_.points()[static_cast<std::size_t>(i)], second_);
      map_.AddObservation(id, first_, i);
      map_.AddObservation(id, second_, i);
      map_.UpdateAppearance(id);
    }
  }

  // All points, made before any keyframe was mapped.
  std::vector<RecentPoint> RecentPoints() const {
    std::vector<RecentPoint> recent;
    for (const MapPointId id : map_.PointIds()) recent.push_back({id, 0});
    return recent;
  }

  SyntheticFrames scene_{kPoints, 3.0, 8.0, 31};
  Map map_{scene_.view()};
  LocalMapperOptions options_;
  KeyFrameId first_, second_;
};

TEST_F(LocalMappingTest, NewPointsLieWhereTheyAre) {
  FillHalf();
  const std::vector<MapPointId> created = CreatePoints(second_, options_, 50.0F, map_);
  EXPECT_GT(created.size(), 80U);
  for (const MapPointId id : created) {
    const auto feature = static_cast<std::size_t>(map_.point(id).FeatureIn(second_));
    EXPECT_GE(feature, kPoints / 2U);
    EXPECT_LT((map_.point(id).position - scene_.points()[feature]).norm(), 0.02);
  }
}

TEST_F(LocalMappingTest, NoPointsFromABaselineTooShort) {
  FillHalf();
  map_.SetPose(second_, CameraAt(0.001));
  EXPECT_TRUE(CreatePoints(second_, options_, 50.0F, map_).empty());
}

ImagePyramid Image(const std::function<double(int x, int y)>& gray, const ViewModel& view) {
  cv::Mat image(static_cast<int>(view.max_y) + 1, static_cast<int>(view.max_x) + 1, CV_8UC1);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x)
      image.at<uchar>(y, x) = cv::saturate_cast<uchar>(gray(x, y));
  }
  return BuildPyramid(GrayImage(image), {});
}

TEST_F(LocalMappingTest, PostsOfAFenceAreRepetitiveAndTextureIsNot) {
  FillHalf();
  Random random(7);
  const auto fence = std::make_shared<ImagePyramid>(
      Image([](int x, int) { return x % 24 < 8 ? 160.0 : 60.0; }, *scene_.view()));
  const auto texture = std::make_shared<ImagePyramid>(
      Image([&](int, int) { return random.Uniform(0.0, 255.0); }, *scene_.view()));
  const auto count = [&](std::shared_ptr<const ImagePyramid> pyramid, double relaxed = 0.0) {
    KeyFrame keyframe = map_.keyframe(second_);
    keyframe.pyramid = std::move(pyramid);
    RepetitionCheck check(map_, keyframe, 0.9);
    check.Relax(relaxed);
    int repetitive = 0;
    for (int i = 0; i < kPoints; ++i) repetitive += check.IsRepetitive(i, map_.keyframe(first_));
    return repetitive;
  };
  EXPECT_GT(count(fence), kPoints / 2);         // the others are at the border, or outside
  EXPECT_EQ(count(fence, 0.95), count(fence));  // its posts are all the same
  EXPECT_EQ(count(fence, 1.0), 0);
  EXPECT_EQ(count(texture), 0);
  EXPECT_EQ(count(nullptr), 0);
}

TEST_F(LocalMappingTest, RelaxedRepetitionCheckKeepsWhatItMeasured) {
  FillHalf();
  KeyFrame keyframe = map_.keyframe(second_);
  keyframe.pyramid = std::make_shared<ImagePyramid>(
      Image([](int x, int) { return x % 24 < 8 ? 160.0 : 60.0; }, *scene_.view()));
  RepetitionCheck check(map_, keyframe, 0.9);
  std::vector<int> repetitive;
  for (int i = 0; i < kPoints; ++i) {
    if (check.IsRepetitive(i, map_.keyframe(first_))) repetitive.push_back(i);
  }
  ASSERT_FALSE(repetitive.empty());
  check.Relax(1.0);
  for (const int i : repetitive) EXPECT_FALSE(check.IsRepetitive(i, map_.keyframe(first_)));
  check.Relax(0.5);  // never stricter again
  for (const int i : repetitive) EXPECT_FALSE(check.IsRepetitive(i, map_.keyframe(first_)));
}

TEST_F(LocalMappingTest, RecentPointsRarelyFoundAreCulled) {
  FillHalf();
  std::vector<RecentPoint> recent = RecentPoints();
  const MapPointId rare = recent[0].id;
  map_.point(rare).num_visible = 20;
  map_.point(rare).num_found = 2;
  const CulledPoints culled = CullRecentPoints(options_, /*num_mapped=*/0, map_, recent);
  EXPECT_EQ(culled.rarely_found, 1);
  EXPECT_EQ(culled.few_observers, 0);
  EXPECT_EQ(map_.FindPoint(rare), nullptr);
  EXPECT_EQ(recent.size(), kPoints / 2U - 1U);
}

TEST_F(LocalMappingTest, PointsSeenTwiceAreCulledOnceTwoMoreKeyFramesHaveCome) {
  FillHalf();
  std::vector<RecentPoint> recent = RecentPoints();
  EXPECT_EQ(CullRecentPoints(options_, /*num_mapped=*/1, map_, recent).few_observers, 0);
  EXPECT_EQ(CullRecentPoints(options_, /*num_mapped=*/2, map_, recent).few_observers, kPoints / 2);
  EXPECT_TRUE(recent.empty());
}

TEST_F(LocalMappingTest, RedundantKeyFramesAreCulledButNotTheFirst) {
  scene_.FillMap({CameraAt(0.0), CameraAt(0.1), CameraAt(0.2), CameraAt(0.3), CameraAt(0.4)}, map_);
  const int erased = CullKeyFrames(map_.newest_keyframe(), options_, map_);
  EXPECT_GE(erased, 1);
  EXPECT_NE(map_.FindKeyFrame(KeyFrameId(0)), nullptr);
  EXPECT_NE(map_.FindKeyFrame(map_.newest_keyframe()), nullptr);
  EXPECT_EQ(map_.num_keyframes(), 5 - erased);
  EXPECT_EQ(map_.num_points(), kPoints);
}

TEST_F(LocalMappingTest, KeyFramesWithPointsOfTheirOwnStay) {
  FillHalf();
  map_.AddKeyFrame(scene_.MakeFrame(2, CameraAt(0.5)));
  EXPECT_EQ(CullKeyFrames(second_, options_, map_), 0);
}

TEST_F(LocalMappingTest, FusionConnectsAKeyFrameWithWhatItSees) {
  FillHalf();
  Frame third = scene_.MakeFrame(2, CameraAt(0.5));
  for (std::size_t i = 0; i < 30; ++i) third.map_points[i] = map_.keyframe(first_).map_points[i];
  const KeyFrameId id = map_.AddKeyFrame(third);
  const FusionCounts counts = FuseWithNeighbors(id, options_, 50.0F, map_);
  EXPECT_GT(counts.observations_added, 50);
  EXPECT_GT(map_.covisibility().SharedPoints(id, first_), 80);
}

TEST_F(LocalMappingTest, OneStepRepairsADisturbedPoseAndMakesPoints) {
  FillHalf();
  Frame third = scene_.MakeFrame(2, CameraAt(0.7), 0.2);
  for (std::size_t i = 0; i < kPoints / 2; ++i) {
    third.map_points[i] = map_.keyframe(first_).map_points[i];
  }
  third.cam_from_world = CameraAt(0.73);
  const KeyFrameId id = map_.AddKeyFrame(third);
  LocalMapper mapper(options_, {});
  const MappingReport report = mapper.Process(id, 50.0F, map_);
  EXPECT_TRUE(report.bundle.solver.usable) << report.bundle.solver.message;
  EXPECT_GT(report.points_created, 50);
  // The scale is free to move a little: compare the ratio of the baselines.
  const double first_step =
      (map_.keyframe(second_).Center() - map_.keyframe(first_).Center()).norm();
  const double second_step = (map_.keyframe(id).Center() - map_.keyframe(second_).Center()).norm();
  EXPECT_NEAR(second_step / first_step, 0.3 / 0.4, 0.02);
}

}  // namespace
}  // namespace lift_slam
