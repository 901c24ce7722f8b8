#include "lift_slam/map/map.h"

#include <gtest/gtest.h>

#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kFeatures = 8;

std::shared_ptr<const ViewModel> TestView() {
  const PinholeIntrinsics pinhole{100.0, 100.0, 50.0, 50.0, 101, 101};
  return std::make_shared<ViewModel>(
      MakeViewModel(pinhole, {0.0, 101.0, 0.0, 101.0}, {8, 1.2},
                    {{50.0F, 100.0F}, {50.0F, 100.0F}, {50.0F, 100.0F}}));
}

Frame MakeFrame(const ViewModel& view, std::int64_t index, const Eigen::Vector3d& center) {
  FeatureSet features;
  features.descriptors = Descriptors({"orb", DescriptorMetric::kHamming, 256}, kFeatures);
  std::vector<Eigen::Vector2f> undistorted;
  for (int i = 0; i < kFeatures; ++i) {
    const float x = 10.0F * static_cast<float>(i + 1);
    features.keypoints.push_back({x, 50.0F, 0.0F, 1.0F, i % 4});
    features.descriptors.mutable_row(static_cast<std::size_t>(i))[0] = std::byte(i);
    undistorted.emplace_back(x, 50.0F);
  }
  Frame frame(index, index * 100,
              std::make_shared<FrameFeatures>(std::move(features), std::move(undistorted), view));
  frame.cam_from_world.translation = -center;
  return frame;
}

// Three keyframes in a row; point i is feature i of each.
class MapTest : public testing::Test {
 protected:
  MapTest() : view_(TestView()), map_(view_) {
    for (int k = 0; k < 3; ++k) {
      keyframes_.push_back(map_.AddKeyFrame(MakeFrame(*view_, k, {0.1 * k, 0.0, 0.0})));
    }
    for (int i = 0; i < kFeatures; ++i) {
      points_.push_back(map_.AddPoint({0.1 * i - 0.4, 0.0, 1.0 + i}, keyframes_[2]));
      for (const KeyFrameId keyframe : keyframes_) map_.AddObservation(points_.back(), keyframe, i);
      map_.UpdateAppearance(points_.back());
    }
  }

  // Points and keyframes must name each other, and edges must count shared points.
  void ExpectConsistent() const {
    for (const MapPointId id : map_.PointIds()) {
      for (const auto& observation : map_.point(id).observations) {
        EXPECT_EQ(map_.keyframe(observation.keyframe)
                      .map_points[static_cast<std::size_t>(observation.feature)],
                  id);
      }
    }
    for (const KeyFrameId a : map_.KeyFrameIds()) {
      for (const MapPointId id : map_.keyframe(a).map_points) {
        if (id.valid()) {
          EXPECT_GE(map_.point(id).FeatureIn(a), 0);
        }
      }
      for (const KeyFrameId b : map_.KeyFrameIds()) {
        if (a == b) continue;
        int shared = 0;
        for (const MapPointId id : map_.PointIds()) {
          shared += map_.point(id).FeatureIn(a) >= 0 && map_.point(id).FeatureIn(b) >= 0 ? 1 : 0;
        }
        EXPECT_EQ(map_.covisibility().SharedPoints(a, b), shared);
      }
    }
  }

  std::shared_ptr<const ViewModel> view_;
  Map map_;
  std::vector<KeyFrameId> keyframes_;
  std::vector<MapPointId> points_;
};

TEST_F(MapTest, CovisibilityCountsSharedPoints) {
  EXPECT_EQ(map_.covisibility().SharedPoints(keyframes_[0], keyframes_[1]), kFeatures);
  ExpectConsistent();
}

TEST_F(MapTest, RemovingObservationsErasesAPointSeenOnce) {
  map_.RemoveObservation(points_[0], keyframes_[0]);
  ASSERT_NE(map_.FindPoint(points_[0]), nullptr);
  ExpectConsistent();
  map_.RemoveObservation(points_[0], keyframes_[1]);
  EXPECT_EQ(map_.FindPoint(points_[0]), nullptr);
  EXPECT_EQ(map_.num_points(), kFeatures - 1);
  EXPECT_FALSE(map_.keyframe(keyframes_[2]).map_points[0].valid());
  ExpectConsistent();
}

TEST_F(MapTest, MergedPointTakesOverObservationsOnlyWhereFree) {
  map_.RemoveObservation(points_[1], keyframes_[0]);
  map_.MergePoints(points_[0], points_[1]);
  EXPECT_EQ(map_.FindPoint(points_[0]), nullptr);
  EXPECT_EQ(map_.point(points_[1]).FeatureIn(keyframes_[0]), 0);
  EXPECT_EQ(map_.point(points_[1]).FeatureIn(keyframes_[1]), 1);
  ExpectConsistent();
}

TEST_F(MapTest, RandomOperationsKeepEverythingConsistent) {
  Random random(5);
  for (int step = 0; step < 200; ++step) {
    const auto ids = map_.PointIds();
    if (ids.size() < 2) break;
    const auto pick = [&] {
      return ids[static_cast<std::size_t>(random.UniformInt(0, static_cast<int>(ids.size()) - 1))];
    };
    const MapPointId a = pick(), b = pick();
    switch (random.UniformInt(0, 3)) {
      case 0:
        if (a != b) map_.MergePoints(a, b);
        break;
      case 1:
        map_.RemoveObservation(a, map_.point(a).observations.front().keyframe);
        break;
      case 2:
        if (map_.num_keyframes() > 2 && step > 100) map_.EraseKeyFrame(map_.KeyFrameIds()[1]);
        break;
      default: {
        const MapPointId added = map_.AddPoint({0, 0, 2}, map_.newest_keyframe());
        int seen = 0;
        for (const KeyFrameId id : map_.KeyFrameIds()) {
          const int feature = random.UniformInt(0, kFeatures - 1);
          if (map_.keyframe(id).map_points[static_cast<std::size_t>(feature)].valid()) continue;
          map_.AddObservation(added, id, feature);
          ++seen;
        }
        if (seen < 2) map_.ErasePoint(added);
      }
    }
    ExpectConsistent();
  }
}

TEST_F(MapTest, ErasedKeyFrameResolvesToItsNeighbourWithTheSamePose) {
  const Rigid3d before = map_.keyframe(keyframes_[1]).cam_from_world;
  map_.EraseKeyFrame(keyframes_[1]);
  EXPECT_EQ(map_.FindKeyFrame(keyframes_[1]), nullptr);
  const auto reference = map_.ResolveReference(keyframes_[1]);
  ASSERT_TRUE(reference.has_value());
  const Rigid3d after =
      reference->cam_from_keyframe * map_.keyframe(reference->keyframe).cam_from_world;
  EXPECT_LT((after.translation - before.translation).norm(), 1e-12);
  ExpectConsistent();
}

TEST_F(MapTest, TakenFeatureIsRefused) {
  const MapPointId extra = map_.AddPoint({0, 0, 1}, keyframes_[0]);
  EXPECT_THROW(map_.AddObservation(extra, keyframes_[0], 0), CheckError);
}

TEST_F(MapTest, DistanceRangeFollowsTheLevelOfTheFirstObservation) {
  const MapPoint& point = map_.point(points_[3]);  // feature 3 is on level 3
  const double distance = (point.position - map_.keyframe(keyframes_[0]).Center()).norm();
  EXPECT_NEAR(point.max_distance, distance * std::pow(1.2, 3), 1e-5);
  EXPECT_NEAR(point.min_distance, point.max_distance / std::pow(1.2, 7), 1e-5);
}

TEST(FrameFeatures, SquareSearchFindsJustWhatLiesInside) {
  const auto view = TestView();
  const Frame frame = MakeFrame(*view, 0, Eigen::Vector3d::Zero());
  std::vector<int> found;
  frame.features->ForEachInSquare(35.0F, 50.0F, 6.0F, [&](int i) { found.push_back(i); });
  EXPECT_EQ(found, (std::vector<int>{2, 3}));
  found.clear();
  frame.features->ForEachInSquare(35.0F, 80.0F, 6.0F, [&](int i) { found.push_back(i); });
  EXPECT_TRUE(found.empty());
}

TEST(FrameFeatures, SegmentSearchOffersAllFeaturesOnTheSegment) {
  const auto view = TestView();
  const Frame frame = MakeFrame(*view, 0, Eigen::Vector3d::Zero());
  std::vector<int> found;
  frame.features->ForEachNearSegment({15.0F, 49.0F}, {55.0F, 51.0F}, 2.0F,
                                     [&](int i) { found.push_back(i); });
  for (const int expected : {1, 2, 3, 4}) {
    EXPECT_NE(std::find(found.begin(), found.end(), expected), found.end()) << expected;
  }
  EXPECT_EQ(std::find(found.begin(), found.end(), 7), found.end());
}

TEST(CovisibilityGraph, NeighborsComeByWeightThenId) {
  CovisibilityGraph graph;
  graph.AddShared(KeyFrameId(0), KeyFrameId(3), 5);
  graph.AddShared(KeyFrameId(0), KeyFrameId(1), 7);
  graph.AddShared(KeyFrameId(2), KeyFrameId(0), 5);
  const auto neighbors = graph.Neighbors(KeyFrameId(0), 5);
  ASSERT_EQ(neighbors.size(), 3U);
  EXPECT_EQ(neighbors[0].keyframe, KeyFrameId(1));
  EXPECT_EQ(neighbors[1].keyframe, KeyFrameId(2));
  EXPECT_EQ(neighbors[2].keyframe, KeyFrameId(3));
  graph.Erase(KeyFrameId(1));
  EXPECT_EQ(graph.Neighbors(KeyFrameId(0), 1).size(), 2U);
}

}  // namespace
}  // namespace lift_slam
