#include "lift_slam/datasets/decimal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lift_slam {
namespace {

TEST(ParseSecondsAsNs, KeepsEveryDigitOfEurocStamps) {
  EXPECT_EQ(ParseSecondsAsNs("1403715276.512143104"), 1403715276512143104);
  EXPECT_EQ(ParseScaledDecimal("1403715276512143104", 0), 1403715276512143104);
}

TEST(ParseSecondsAsNs, ReadsScientificNotation) {
  EXPECT_EQ(ParseSecondsAsNs("1.037359e-01"), 103735900);
  EXPECT_EQ(ParseSecondsAsNs("0.000000e+00"), 0);
  EXPECT_EQ(ParseSecondsAsNs("4.706E+2"), 470600000000);
  EXPECT_EQ(ParseSecondsAsNs("1e-400"), 0);
}

TEST(ParseSecondsAsNs, RoundsBeyondNanosecondsToNearest) {
  EXPECT_EQ(ParseSecondsAsNs("0.0000000014999"), 1);
  EXPECT_EQ(ParseSecondsAsNs("0.0000000015"), 2);
  EXPECT_EQ(ParseSecondsAsNs("-0.0000000015"), -2);
  EXPECT_EQ(ParseSecondsAsNs("0.0000000005"), 1);
  EXPECT_EQ(ParseSecondsAsNs("0.9999999999"), 1000000000);
  EXPECT_EQ(ParseSecondsAsNs("0.00000000001"), 0);
}

TEST(ParseSecondsAsNs, AcceptsSignsAndBareParts) {
  EXPECT_EQ(ParseSecondsAsNs("+1."), 1000000000);
  EXPECT_EQ(ParseSecondsAsNs("-.5"), -500000000);
  EXPECT_EQ(ParseSecondsAsNs("000012"), 12000000000);
}

TEST(ParseSecondsAsNs, RefusesWhatIsNoFiniteDecimal) {
  for (const char* text : {"", "nan", "inf", "1.2.3", "abc", "1e", "1e+", "1e+-2", "e5", ".", "-",
                           "1 ", "0x10", "--1", "1,5"}) {
    EXPECT_EQ(ParseSecondsAsNs(text), std::nullopt) << text;
  }
}

TEST(ParseSecondsAsNs, RefusesWhatDoesNotFit) {
  EXPECT_EQ(ParseSecondsAsNs("9223372036.854775807"), 9223372036854775807);
  EXPECT_EQ(ParseSecondsAsNs("9223372036.854775808"), std::nullopt);
  EXPECT_EQ(ParseSecondsAsNs("9223372036.8547758075"), std::nullopt);
  EXPECT_EQ(ParseSecondsAsNs("1403715276512143104"), std::nullopt);
  EXPECT_EQ(ParseSecondsAsNs("1e999999999999999999999"), std::nullopt);
}

TEST(ParseDateAsNs, CountsFrom1970) {
  EXPECT_EQ(ParseDateAsNs("1970-01-01", "00:00:00.000000001"), 1);
  EXPECT_EQ(ParseDateAsNs("2011-09-26", "13:02:25.964389445"), 1317042145964389445);
  EXPECT_EQ(ParseDateAsNs("2012-02-29", "00:00:00"), 1330473600000000000);
}

TEST(ParseDateAsNs, RefusesImpossibleDates) {
  EXPECT_EQ(ParseDateAsNs("2011-02-29", "00:00:00"), std::nullopt);
  EXPECT_EQ(ParseDateAsNs("2011-13-01", "00:00:00"), std::nullopt);
  EXPECT_EQ(ParseDateAsNs("2011-01-01", "25:00:00"), std::nullopt);
  EXPECT_EQ(ParseDateAsNs("2011-01-01", "nonsense"), std::nullopt);
  EXPECT_EQ(ParseDateAsNs("26.09.2011", "13:02:25"), std::nullopt);
}

TEST(ParseDouble, ReadsWhatFilesHold) {
  EXPECT_EQ(ParseDouble("7.188560000000e+02"), 718.856);
  EXPECT_EQ(ParseDouble("1."), 1.0);
  EXPECT_EQ(ParseDouble("+.5"), 0.5);
  EXPECT_EQ(ParseDouble("1e-400"), 0.0);
  EXPECT_EQ(ParseDouble("1e400"), std::nullopt);
  EXPECT_EQ(ParseDouble("1.0x"), std::nullopt);
  EXPECT_TRUE(std::isnan(*ParseDouble("NaN")));
}

}  // namespace
}  // namespace lift_slam
