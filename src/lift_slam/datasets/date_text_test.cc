#include "lift_slam/datasets/date_text.h"

#include <gtest/gtest.h>

namespace lift_slam {
namespace {

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

}  // namespace
}  // namespace lift_slam
