#include "lift_slam/place_recognition/bag_of_words.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::ElementsAre;

BagOfWords RandomBag(Random& random) {
  std::vector<WordWeight> weights;
  for (int i = 0; i < 60; ++i) {
    weights.push_back({static_cast<std::uint32_t>(random.UniformInt(0, 99)),
                       static_cast<float>(random.Uniform(0.5, 5.0))});
  }
  return BagOfWords::FromWeights(std::move(weights));
}

std::vector<double> Dense(const BagOfWords& bag) {
  std::vector<double> values(100);
  for (const WordWeight& entry : bag.words) values[entry.word] = static_cast<double>(entry.weight);
  return values;
}

TEST(BagOfWords, AddsUpSortsAndNormalises) {
  const BagOfWords bag = BagOfWords::FromWeights({{7, 1}, {3, 2}, {7, 1}, {5, 0}});
  EXPECT_THAT(bag.words, ElementsAre(WordWeight{3, 0.5F}, WordWeight{7, 0.5F}));
  EXPECT_FLOAT_EQ(bag.norm, std::sqrt(0.5F));
}

TEST(BagOfWords, NothingScoresNothing) {
  const BagOfWords none = BagOfWords::FromWeights({}), some = BagOfWords::FromWeights({{1, 1}});
  for (const BagScore score : {BagScore::kL1, BagScore::kL2}) {
    EXPECT_EQ(Score(none, none, score), 0.0);
    EXPECT_EQ(Score(none, some, score), 0.0);
    EXPECT_EQ(Score(some, BagOfWords::FromWeights({{2, 1}}), score), 0.0);
    EXPECT_NEAR(Score(some, some, score), 1.0, 1e-3);
  }
}

TEST(BagOfWords, ScoresMatchTheirDefinitions) {
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const BagOfWords a = RandomBag(random), b = RandomBag(random);
    const std::vector<double> v = Dense(a), w = Dense(b);
    double l1 = 0.0, l2 = 0.0, vv = 0.0, ww = 0.0;
    for (std::size_t i = 0; i < 100; ++i) {
      vv += v[i] * v[i];
      ww += w[i] * w[i];
    }
    for (std::size_t i = 0; i < 100; ++i) {
      l1 += std::abs(v[i] - w[i]);
      l2 += std::pow(v[i] / std::sqrt(vv) - w[i] / std::sqrt(ww), 2);
    }
    EXPECT_NEAR(Score(a, b, BagScore::kL1), 1.0 - 0.5 * l1, 1e-6);
    EXPECT_NEAR(Score(a, b, BagScore::kL2), 1.0 - std::sqrt(0.5 * l2), 1e-6);
    EXPECT_EQ(Score(a, b, BagScore::kL2), Score(b, a, BagScore::kL2));
  }
}

TEST(DirectIndex, GroupsFeaturesByNode) {
  const DirectIndex index = DirectIndex::FromNodes({9, 2, 9, 4});
  EXPECT_THAT(index.nodes, ElementsAre(2, 4, 9));
  EXPECT_THAT(index.group(0), ElementsAre(1));
  EXPECT_THAT(index.group(1), ElementsAre(3));
  EXPECT_THAT(index.group(2), ElementsAre(0, 2));
}

TEST(DirectIndex, VisitsSharedNodesOnly) {
  const DirectIndex a = DirectIndex::FromNodes({9, 2, 9, 4}), b = DirectIndex::FromNodes({3, 9, 2});
  std::vector<std::vector<std::uint32_t>> seen;
  ForEachSharedNode(a, b, [&](auto of_a, auto of_b) {
    seen.push_back({of_a.begin(), of_a.end()});
    seen.push_back({of_b.begin(), of_b.end()});
  });
  EXPECT_THAT(seen, ElementsAre(ElementsAre(1), ElementsAre(2), ElementsAre(0, 2), ElementsAre(1)));
}

}  // namespace
}  // namespace lift_slam
