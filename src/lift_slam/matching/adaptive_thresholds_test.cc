#include "lift_slam/matching/adaptive_thresholds.h"

#include <gtest/gtest.h>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

const ThresholdRange kRange{{1.5F, 2.5F}, {1.0F, 2.0F}, {2.0F, 3.0F}};

AdaptiveThresholds Repeated(AdaptiveThresholds state, int matches, int outliers, int times) {
  for (int i = 0; i < times; ++i) state = Adapt(state, MatchingOptions(), matches, outliers);
  return state;
}

TEST(AdaptiveThresholds, FixedOnesNeverMove) {
  for (const double looseness : {0.0, 0.3, 1.0}) {
    const MatchingThresholds t = AdaptiveThresholds{looseness}.In(kRange, ThresholdMode::kFixed);
    EXPECT_EQ(t.low, 1.5F);
    EXPECT_EQ(t.high, 2.5F);
  }
}

TEST(AdaptiveThresholds, MoveBetweenStrictAndLoose) {
  const MatchingThresholds strict = AdaptiveThresholds{0.0}.In(kRange, ThresholdMode::kAdaptive);
  EXPECT_EQ(strict.low, 1.0F);
  EXPECT_EQ(strict.high, 2.0F);
  const MatchingThresholds middle = AdaptiveThresholds{0.5}.In(kRange, ThresholdMode::kAdaptive);
  EXPECT_FLOAT_EQ(middle.low, 1.5F);
  EXPECT_FLOAT_EQ(middle.high, 2.5F);
  const MatchingThresholds loose = AdaptiveThresholds{1.0}.In(kRange, ThresholdMode::kAdaptive);
  EXPECT_EQ(loose.low, 2.0F);
  EXPECT_EQ(loose.high, 3.0F);
}

TEST(AdaptiveThresholds, PlentyOfGoodMatchesMakesThemStrict) {
  EXPECT_EQ(Repeated({1.0}, 400, 20, 50).looseness, 0.0);
}

TEST(AdaptiveThresholds, FewGoodMatchesMakeThemLooseAtOnce) {
  EXPECT_EQ(Adapt({0.0}, MatchingOptions(), 50, 0).looseness, 1.0);
}

TEST(AdaptiveThresholds, OutliersCountAgainstMatches) {
  EXPECT_EQ(Adapt({0.0}, MatchingOptions(), 300, 250).looseness, 1.0);
  EXPECT_EQ(Adapt({0.0}, MatchingOptions(), 300, 50).looseness, 0.0);
}

TEST(AdaptiveThresholds, FewerGoodMatchesNeverMakeThemStricter) {
  double previous = -1.0;
  for (int good = 250; good >= 0; good -= 10) {
    const double looseness = Repeated({0.5}, good, 0, 50).looseness;
    EXPECT_GE(looseness, previous) << good;
    previous = looseness;
  }
}

TEST(AdaptiveThresholds, FallSlowly) {
  const MatchingOptions options;
  EXPECT_DOUBLE_EQ(Adapt({1.0}, options, 400, 0).looseness, 1.0 - options.max_fall);
}

TEST(AdaptiveThresholds, SmallChangesAreLeftOut) {
  const MatchingOptions options;
  const AdaptiveThresholds settled = Repeated({0.0}, 130, 0, 5);
  ASSERT_DOUBLE_EQ(settled.looseness, 0.5);
  for (const int wobble : {-5, 5, -3, 3}) {
    EXPECT_EQ(Adapt(settled, options, 130 + wobble, 0).looseness, settled.looseness) << wobble;
  }
}

TEST(AdaptiveThresholds, OptionsOutOfRangeAreNamed) {
  MatchingOptions options;
  options.plenty = options.few;
  try {
    options.Check();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("matching.plenty"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lift_slam
