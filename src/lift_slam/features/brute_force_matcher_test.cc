#include "lift_slam/features/brute_force_matcher.h"

#include <gtest/gtest.h>

#include <cstring>

#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

const DescriptorKind kFloats{"test", DescriptorMetric::kL2, 128};
const DescriptorKind kBits{"bits", DescriptorMetric::kHamming, 256};

// `offset`: common to all values, as in descriptors whose mean is large.
Descriptors RandomFloats(std::size_t rows, std::uint64_t seed, double offset) {
  Random random(seed);
  Descriptors descriptors(kFloats, rows);
  for (std::size_t i = 0; i < rows; ++i) {
    float values[128];
    for (float& v : values) v = static_cast<float>(offset + random.Normal());
    std::memcpy(descriptors.mutable_row(i).data(), values, sizeof values);
  }
  return descriptors;
}

Descriptors RandomBits(std::size_t rows, std::uint64_t seed) {
  Random random(seed);
  Descriptors descriptors(kBits, rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::byte& b : descriptors.mutable_row(i)) b = static_cast<std::byte>(random.Bits());
  }
  return descriptors;
}

DescriptorNeighbours BySearch(const Descriptors& queries, std::size_t i, const Descriptors& all) {
  DescriptorNeighbours found;
  for (std::size_t j = 0; j < all.size(); ++j) {
    const float distance = DescriptorDistance(queries.kind(), queries.row(i), all.row(j));
    if (distance < found.best_distance) {
      found = {static_cast<int>(j), found.best, distance, found.best_distance};
    } else if (distance < found.second_distance) {
      found.second = static_cast<int>(j);
      found.second_distance = distance;
    }
  }
  return found;
}

void ExpectAsBySearch(const Descriptors& queries, const Descriptors& candidates) {
  const auto found = FindNearest(queries, candidates);
  ASSERT_EQ(found.size(), queries.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const DescriptorNeighbours expected = BySearch(queries, i, candidates);
    EXPECT_EQ(found[i].best, expected.best) << i;
    EXPECT_EQ(found[i].second, expected.second) << i;
    EXPECT_EQ(found[i].best_distance, expected.best_distance) << i;
    EXPECT_EQ(found[i].second_distance, expected.second_distance) << i;
  }
}

TEST(FindNearest, FloatsAsByPlainSearch) {
  for (const double offset : {0.0, 40.0}) {
    ExpectAsBySearch(RandomFloats(301, 1, offset), RandomFloats(157, 2, offset));
  }
}

TEST(FindNearest, BitsAsByPlainSearch) { ExpectAsBySearch(RandomBits(61, 1), RandomBits(57, 2)); }

TEST(FindNearest, FewCandidatesLeaveNeighboursOut) {
  const Descriptors queries = RandomFloats(3, 1, 0.0);
  EXPECT_EQ(FindNearest(queries, RandomFloats(0, 2, 0.0)).at(2).best, -1);
  const DescriptorNeighbours one = FindNearest(queries, RandomFloats(1, 2, 0.0)).at(2);
  EXPECT_EQ(one.best, 0);
  EXPECT_EQ(one.second, -1);
  EXPECT_TRUE(one.IsDistinctive(0.1F));
}

TEST(FindNearest, RefusesDescriptorsOfTwoKinds) {
  EXPECT_THROW(FindNearest(RandomFloats(2, 1, 0.0), RandomBits(2, 1)), CheckError);
}

// b has the rows of a in reverse order, a little off, and a row that resembles row 0 too.
TEST(MatchMutualNearest, FindsMovedRowsAndRatioRefusesDoubles) {
  const Descriptors a = RandomFloats(50, 1, 5.0);
  Descriptors b(kFloats, 51);
  Random random(3);
  for (std::size_t i = 0; i <= 50; ++i) {
    float values[128];
    std::memcpy(values, a.row(i == 50 ? 0 : 49 - i).data(), sizeof values);
    for (float& v : values) v += static_cast<float>(0.1 * random.Normal());
    std::memcpy(b.mutable_row(i).data(), values, sizeof values);
  }
  const auto all = MatchMutualNearest(a, b, 1.0F);
  ASSERT_EQ(all.size(), 50U);
  for (const DescriptorMatch& match : all) {
    if (match.a > 0) {
      EXPECT_EQ(match.b, 49 - match.a);
    }
    EXPECT_LT(match.distance, 2.0F);
  }
  const auto distinctive = MatchMutualNearest(a, b, 0.6F);
  ASSERT_EQ(distinctive.size(), 49U);
  EXPECT_EQ(distinctive.front().a, 1);
}

// Both rows of a are nearest to the one row of b: only the nearer is kept.
TEST(MatchMutualNearest, OneRowIsMatchedOnce) {
  const Descriptors a = RandomFloats(2, 1, 0.0);
  Descriptors b(kFloats, 1);
  std::memcpy(b.mutable_data(), a.row(1).data(), kFloats.BytesPerRow());
  const auto matches = MatchMutualNearest(a, b, 0.8F);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_EQ(matches[0].a, 1);
  EXPECT_EQ(matches[0].distance, 0.0F);
}

}  // namespace
}  // namespace lift_slam
