#include "lift_slam/util/number_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lift_slam {
namespace {

TEST(ParseDouble, ReadsWhatFilesHold) {
  EXPECT_EQ(ParseDouble("7.188560000000e+02"), 718.856);
  EXPECT_EQ(ParseDouble("1."), 1.0);
  EXPECT_EQ(ParseDouble("+.5"), 0.5);
  EXPECT_EQ(ParseDouble("1e-400"), 0.0);
  EXPECT_EQ(ParseDouble("1e400"), std::nullopt);
  EXPECT_EQ(ParseDouble("1.0x"), std::nullopt);
  EXPECT_TRUE(std::isnan(*ParseDouble("NaN")));
}

TEST(ParseIndex, TakesDigitsAlone) {
  EXPECT_EQ(ParseIndex("000012"), 12);
  EXPECT_EQ(ParseIndex("9223372036854775807"), INT64_MAX);
  for (const char* text : {"", "-1", "+1", "1.0", "1 ", "9223372036854775808"}) {
    EXPECT_EQ(ParseIndex(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace lift_slam
