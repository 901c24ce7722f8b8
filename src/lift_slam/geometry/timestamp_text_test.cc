#include "lift_slam/geometry/timestamp_text.h"

#include <gtest/gtest.h>

namespace lift_slam {
namespace {

TEST(TimestampText, ReadsDecimalAndScientificTextExactly) {
  EXPECT_EQ(ParseSeconds("1403715529.112143517"), 1403715529112143517);
  EXPECT_EQ(ParseSeconds("1.403715529112143517e+09"), 1403715529112143517);
  EXPECT_EQ(ParseNanoseconds("1403715529112143517"), 1403715529112143517);
  EXPECT_EQ(ParseNanoseconds("1403715529112143517.000000"), 1403715529112143517);
  EXPECT_EQ(ParseSeconds("1.037359e-01"), 103735900);
  EXPECT_EQ(ParseSeconds("0.000000e+00"), 0);
  EXPECT_EQ(ParseSeconds("-0.5"), -500000000);
  EXPECT_EQ(ParseSeconds("+.25"), 250000000);
  EXPECT_EQ(ParseSeconds("3."), 3000000000);
  EXPECT_EQ(ParseSeconds("1e-30"), 0);
  EXPECT_EQ(ParseSeconds("0.0000000015"), 2);
  EXPECT_EQ(ParseSeconds("0.9999999999"), 1000000000);
  EXPECT_EQ(ParseNanoseconds("9223372036854775807"), INT64_MAX);
}

TEST(TimestampText, RefusesWhatIsNoNumberOrTooLarge) {
  for (const char* text : {"", ".", "-", "e5", "1e", "1e+", "1.2.3", "nan", "inf", "12s", "0x10",
                           "1e99999999999", "1e--5"}) {
    EXPECT_EQ(ParseSeconds(text), std::nullopt) << text;
  }
  EXPECT_EQ(ParseNanoseconds("9223372036854775808"), std::nullopt);
  EXPECT_EQ(ParseSeconds("1403715529112143517"), std::nullopt);
  EXPECT_EQ(ParseSeconds("1e20"), std::nullopt);
}

TEST(TimestampText, FormatsExactly) {
  for (const std::int64_t stamp :
       {std::int64_t{0}, std::int64_t{-1}, std::int64_t{1403715529112143517}, INT64_MAX}) {
    EXPECT_EQ(ParseSeconds(FormatSeconds(stamp)), stamp);
  }
  EXPECT_EQ(FormatSeconds(-1500000000), "-1.500000000");
}

TEST(ParseSeconds, KeepsEveryDigitOfEurocStamps) {
  EXPECT_EQ(ParseSeconds("1403715276.512143104"), 1403715276512143104);
  EXPECT_EQ(ParseNanoseconds("1403715276512143104"), 1403715276512143104);
}

TEST(ParseSeconds, ReadsScientificNotation) {
  EXPECT_EQ(ParseSeconds("1.037359e-01"), 103735900);
  EXPECT_EQ(ParseSeconds("0.000000e+00"), 0);
  EXPECT_EQ(ParseSeconds("4.706E+2"), 470600000000);
  EXPECT_EQ(ParseSeconds("1e-400"), 0);
}

TEST(ParseSeconds, RoundsBeyondNanosecondsToNearest) {
  EXPECT_EQ(ParseSeconds("0.0000000014999"), 1);
  EXPECT_EQ(ParseSeconds("0.0000000015"), 2);
  EXPECT_EQ(ParseSeconds("-0.0000000015"), -2);
  EXPECT_EQ(ParseSeconds("0.0000000005"), 1);
  EXPECT_EQ(ParseSeconds("0.9999999999"), 1000000000);
  EXPECT_EQ(ParseSeconds("0.00000000001"), 0);
}

TEST(ParseSeconds, AcceptsSignsAndBareParts) {
  EXPECT_EQ(ParseSeconds("+1."), 1000000000);
  EXPECT_EQ(ParseSeconds("-.5"), -500000000);
  EXPECT_EQ(ParseSeconds("000012"), 12000000000);
}

TEST(ParseSeconds, RefusesWhatIsNoFiniteDecimal) {
  for (const char* text : {"", "nan", "inf", "1.2.3", "abc", "1e", "1e+", "1e+-2", "e5", ".", "-",
                           "1 ", "0x10", "--1", "1,5"}) {
    EXPECT_EQ(ParseSeconds(text), std::nullopt) << text;
  }
}

TEST(ParseSeconds, RefusesWhatDoesNotFit) {
  EXPECT_EQ(ParseSeconds("9223372036.854775807"), 9223372036854775807);
  EXPECT_EQ(ParseSeconds("9223372036.854775808"), std::nullopt);
  EXPECT_EQ(ParseSeconds("9223372036.8547758075"), std::nullopt);
  EXPECT_EQ(ParseSeconds("1403715276512143104"), std::nullopt);
  EXPECT_EQ(ParseSeconds("1e999999999999999999999"), std::nullopt);
}

}  // namespace
}  // namespace lift_slam
