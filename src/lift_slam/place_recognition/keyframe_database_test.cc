#include "lift_slam/place_recognition/keyframe_database.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

BagOfWords RandomBag(Random& random, int num_words) {
  std::vector<WordWeight> weights;
  for (int i = 0; i < 40; ++i) {
    weights.push_back({static_cast<std::uint32_t>(random.UniformInt(0, num_words - 1)),
                       static_cast<float>(random.Uniform(0.5, 5.0))});
  }
  return BagOfWords::FromWeights(std::move(weights));
}

std::vector<BagOfWords> RandomBags(int count) {
  Random random(2);
  std::vector<BagOfWords> bags;
  for (int i = 0; i < count; ++i) bags.push_back(RandomBag(random, 300));
  return bags;
}

int CommonWords(const BagOfWords& a, const BagOfWords& b) {
  int count = 0;
  for (const WordWeight& x : a.words) {
    for (const WordWeight& y : b.words) count += x.word == y.word;
  }
  return count;
}

TEST(KeyframeDatabase, FindsWhatAComparisonWithEveryKeyframeFinds) {
  const std::vector<BagOfWords> bags = RandomBags(60);
  for (const BagScore score : {BagScore::kL1, BagScore::kL2}) {
    KeyframeDatabase database(score);
    for (int i = 1; i < 60; ++i) database.Add(10 * i, bags[static_cast<std::size_t>(i)]);
    std::size_t with_words = 0;
    const auto candidates = database.Query(bags[0]);
    for (std::size_t i = 1; i < 60; ++i) with_words += CommonWords(bags[0], bags[i]) > 0;
    EXPECT_EQ(candidates.size(), with_words);
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const BagOfWords& bag = bags[static_cast<std::size_t>(candidates[i].keyframe / 10)];
      EXPECT_EQ(candidates[i].score, Score(bags[0], bag, score));
      EXPECT_EQ(candidates[i].common_words, CommonWords(bags[0], bag));
      EXPECT_GE(candidates[i > 0 ? i - 1 : 0].score, candidates[i].score);
    }
  }
}

TEST(KeyframeDatabase, LeavesOutExcludedAndRemovedKeyframes) {
  const std::vector<BagOfWords> bags = RandomBags(20);
  KeyframeDatabase all(BagScore::kL1), some(BagScore::kL1);
  for (int i = 0; i < 20; ++i) {
    all.Add(i, bags[static_cast<std::size_t>(i)]);
    if (i != 3 && i != 8) some.Add(i, bags[static_cast<std::size_t>(i)]);
  }
  EXPECT_EQ(all.Query(bags[0], std::vector<int>{8, 3, 99}), some.Query(bags[0]));
  all.Remove(8);
  all.Remove(3);
  all.Remove(3);
  EXPECT_EQ(all.size(), 18U);
  EXPECT_EQ(all.Find(3), nullptr);
  EXPECT_EQ(all.Query(bags[0]), some.Query(bags[0]));
  all.Add(3, bags[3]);
  EXPECT_EQ(all.Query(bags[3])[0].keyframe, 3);
}

TEST(KeyframeDatabase, EqualScoresAreInOrderOfIdWhateverTheOrderOfAdding) {
  const BagOfWords bag = BagOfWords::FromWeights({{1, 1}, {2, 1}});
  KeyframeDatabase database(BagScore::kL2);
  for (const int id : {5, 1, 9, 3}) database.Add(id, bag);
  std::vector<int> ids;
  for (const PlaceCandidate& candidate : database.Query(bag)) ids.push_back(candidate.keyframe);
  EXPECT_THAT(ids, testing::ElementsAre(1, 3, 5, 9));
  EXPECT_THROW(database.Add(5, bag), CheckError);
}

}  // namespace
}  // namespace lift_slam
