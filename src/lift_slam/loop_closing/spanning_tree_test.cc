#include "lift_slam/loop_closing/spanning_tree.h"

#include <gtest/gtest.h>

#include "lift_slam/testing/synthetic_frames.h"

namespace lift_slam {
namespace {

// Keyframes 0 to 4; what they share is set by hand.
class SpanningTreeTest : public testing::Test {
 protected:
  SpanningTreeTest() {
    for (int i = 0; i < 5; ++i) map_.AddKeyFrame(scene_.MakeFrame(i, Rigid3d()));
    Share(0, 1, 10);
    Share(1, 2, 10);
    Share(0, 2, 5);
    Share(1, 3, 10);
    Share(2, 3, 5);
    Share(2, 4, 10);
    for (const KeyFrameId id : map_.KeyFrameIds()) tree_.Add(id, map_);
  }

  void Share(int a, int b, int count) {
    for (int i = 0; i < count; ++i, ++next_feature_) {
      const MapPointId id = map_.AddPoint({0.0, 0.0, 5.0}, KeyFrameId(b));
      map_.AddObservation(id, KeyFrameId(a), next_feature_);
      map_.AddObservation(id, KeyFrameId(b), next_feature_);
    }
  }
  void Erase(int id) {
    map_.EraseKeyFrame(KeyFrameId(id));
    tree_.ForgetErased(map_);
  }
  int ParentOf(int id) const { return tree_.Parent(KeyFrameId(id)).value_or(KeyFrameId()).value; }

  SyntheticFrames scene_{60, 4.0, 6.0, 3};
  Map map_{scene_.view()};
  SpanningTree tree_;
  int next_feature_ = 0;
};

TEST_F(SpanningTreeTest, ParentIsTheOlderKeyFrameThatSharesMost) {
  EXPECT_EQ(ParentOf(0), -1);
  EXPECT_EQ(ParentOf(1), 0);
  EXPECT_EQ(ParentOf(2), 1);
  EXPECT_EQ(ParentOf(3), 1);
  EXPECT_EQ(ParentOf(4), 2);
  EXPECT_EQ(tree_.Edges().size(), 4U);
}

TEST_F(SpanningTreeTest, ChildrenOfAnErasedKeyFrameGoToItsParent) {
  Erase(1);
  EXPECT_FALSE(tree_.Has(KeyFrameId(1)));
  EXPECT_EQ(ParentOf(2), 0);
  EXPECT_EQ(ParentOf(3), 0);
  EXPECT_EQ(ParentOf(4), 2);
}

TEST_F(SpanningTreeTest, SeveralErasedAtOnceLeaveOneTree) {
  map_.EraseKeyFrame(KeyFrameId(1));
  map_.EraseKeyFrame(KeyFrameId(2));
  tree_.ForgetErased(map_);
  EXPECT_EQ(ParentOf(3), 0);
  EXPECT_EQ(ParentOf(4), 0);
}

TEST_F(SpanningTreeTest, OldestChildOfAnErasedRootBecomesTheRoot) {
  Erase(0);
  EXPECT_EQ(ParentOf(1), -1);
  Erase(1);
  EXPECT_EQ(ParentOf(2), -1);
  EXPECT_EQ(ParentOf(3), 2);
  EXPECT_EQ(tree_.Edges().size(), 2U);
}

TEST_F(SpanningTreeTest, AbsorbedTreeKeepsItsShape) {
  SpanningTree other;
  other.Absorb(tree_, 10);
  EXPECT_FALSE(other.Parent(KeyFrameId(10)).has_value());
  EXPECT_EQ(other.Parent(KeyFrameId(14)), KeyFrameId(12));
  EXPECT_EQ(other.Edges().size(), 4U);
}

}  // namespace
}  // namespace lift_slam
