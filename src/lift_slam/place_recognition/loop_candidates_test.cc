#include "lift_slam/place_recognition/loop_candidates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lift_slam {
namespace {

using testing::ElementsAre;
using enum CandidateRejection;

// Keyframes up to two ids apart are covisible, the nearest first.
std::vector<int> Chain(int keyframe) {
  return {keyframe - 1, keyframe + 1, keyframe - 2, keyframe + 2};
}

std::vector<CandidateRejection> Rejections(const std::vector<CandidateVerdict>& verdicts) {
  std::vector<CandidateRejection> rejections;
  for (const CandidateVerdict& verdict : verdicts) rejections.push_back(verdict.rejection);
  return rejections;
}

std::vector<CandidateVerdict> Accepted(const std::vector<int>& keyframes) {
  std::vector<CandidateVerdict> verdicts;
  for (const int keyframe : keyframes) verdicts.push_back({{keyframe, 50, 0.3}, 0.3});
  return verdicts;
}

TEST(LeastCovisibleScore, IsTheLeastOfTheNeighbours) {
  const BagOfWords query = BagOfWords::FromWeights({{1, 1}, {2, 1}});
  const BagOfWords half = BagOfWords::FromWeights({{1, 1}, {3, 1}});
  const std::vector<const BagOfWords*> neighbours = {&query, nullptr, &half};
  EXPECT_DOUBLE_EQ(LeastCovisibleScore(query, neighbours, BagScore::kL1), 0.5);
  EXPECT_EQ(LeastCovisibleScore(query, {}, BagScore::kL1), 0.0);
}

TEST(SelectCandidates, EveryReasonHasItsCase) {
  const std::vector<PlaceCandidate> candidates = {
      {10, 100, 0.50},  // best of the strong group
      {11, 90, 0.40},   // of its group
      {90, 95, 0.30},   // a group of its own: 0.30 against 1.0
      {12, 85, 0.10},   // too little alike, but scores for the group
      {13, 50, 0.60},   // too few words
  };
  CandidateSelectionOptions options;
  options.min_score_ratio = 1.0;
  const auto verdicts = SelectCandidates(candidates, 0.2, Chain, options);
  EXPECT_THAT(Rejections(verdicts),
              ElementsAre(kAccepted, kNotBestOfGroup, kWeakGroup, kLowScore, kFewCommonWords));
  EXPECT_NEAR(verdicts[0].group_score, 0.5 + 0.4 + 0.1, 1e-12);
  EXPECT_EQ(verdicts[3].group_score, 0.0);
}

TEST(SelectCandidates, APlaceInOtherLightMayScoreAThirdOfTheCovisible) {
  const std::vector<PlaceCandidate> candidates = {{10, 100, 0.07}, {50, 100, 0.05}};
  EXPECT_THAT(Rejections(SelectCandidates(candidates, 0.2, Chain, {})),
              ElementsAre(kAccepted, kLowScore));
}

TEST(SelectCandidates, TwoPlacesThatAreEquallyAlikeAreBothKept) {
  const std::vector<PlaceCandidate> candidates = {{10, 100, 0.5}, {50, 100, 0.45}};
  EXPECT_THAT(Rejections(SelectCandidates(candidates, 0.0, Chain, {})),
              ElementsAre(kAccepted, kAccepted));
}

TEST(SelectCandidates, GroupSizeLimitsTheNeighboursThatCount) {
  const std::vector<PlaceCandidate> candidates = {{10, 9, 0.5}, {9, 9, 0.4}, {11, 9, 0.3}};
  CandidateSelectionOptions options;
  options.group_size = 1;
  EXPECT_NEAR(SelectCandidates(candidates, 0.0, Chain, options)[0].group_score, 0.9, 1e-12);
}

TEST(SelectCandidates, NothingGivesNothing) {
  EXPECT_TRUE(SelectCandidates({}, 0.1, Chain, {}).empty());
}

TEST(CheckConsistency, AcceptsTheThirdKeyframeInARow) {
  std::vector<RecognizedGroup> groups;
  std::vector<CandidateRejection> rejections;
  for (const int keyframe : {10, 12, 15, 17}) {  // each overlaps the one before
    auto verdicts = Accepted({keyframe});
    groups = CheckConsistency(groups, Chain, {}, verdicts);
    rejections.push_back(verdicts[0].rejection);
  }
  EXPECT_THAT(rejections, ElementsAre(kInconsistent, kInconsistent, kAccepted, kAccepted));
}

TEST(CheckConsistency, AGapOrAnotherPlaceBeginsAnew) {
  std::vector<RecognizedGroup> groups;
  std::vector<int> consistency;
  for (const std::vector<int>& keyframes :
       {std::vector<int>{10}, {11}, {}, {11}, {60}, {61}, {10, 62}}) {
    auto verdicts = Accepted(keyframes);
    groups = CheckConsistency(groups, Chain, {}, verdicts);
    for (const CandidateVerdict& verdict : verdicts) consistency.push_back(verdict.consistency);
  }
  EXPECT_THAT(consistency, ElementsAre(1, 2, 1, 1, 2, 1, 3));
}

TEST(CheckConsistency, OneInARowIsImmediate) {
  CandidateSelectionOptions options;
  options.min_consistent_keyframes = 1;
  auto verdicts = Accepted({10});
  CheckConsistency({}, Chain, options, verdicts);
  EXPECT_EQ(verdicts[0].rejection, kAccepted);
}

TEST(CheckConsistency, LeavesRejectedCandidatesAlone) {
  auto verdicts = Accepted({10, 20});
  verdicts[1].rejection = kWeakGroup;
  EXPECT_EQ(CheckConsistency({}, Chain, {}, verdicts).size(), 1U);
  EXPECT_THAT(Rejections(verdicts), ElementsAre(kInconsistent, kWeakGroup));
}

}  // namespace
}  // namespace lift_slam
