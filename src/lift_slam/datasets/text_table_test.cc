#include "lift_slam/datasets/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/datasets/dataset_test_files.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

TableRow Row(const std::string& field) { return TableRow("table.txt", 7, {field}); }

TEST(TableRow, IndexIsAWholeNumber) {
  EXPECT_EQ(Row("000012").Index(0), 12);
  EXPECT_EQ(Row("-5").Index(0), -5);
  EXPECT_EQ(Row("+5").Index(0), 5);
  EXPECT_EQ(Row("9223372036854775807").Index(0), INT64_MAX);
  for (const char* text : {"1403636579.050", "1.4e18", "9223372036854775808", "--5", "x", "-"}) {
    EXPECT_THAT(InputErrorOf([&] { Row(text).Index(0); }),
                HasSubstr("table.txt:7: expected a whole number in column 1"));
  }
}

TEST(TableRow, SizesAreWholePixels) {
  EXPECT_EQ(Row("640").SizePx(0), 640);
  EXPECT_EQ(Row("1.392000e+03").SizePx(0), 1392);
  for (const char* text : {"63.6", "0", "-4", "1000001", "1e300", "nan", "wide"}) {
    EXPECT_THAT(InputErrorOf([&] { Row(text).SizePx(0); }), HasSubstr("table.txt:7: expected a"));
  }
}

TEST(ReadTable, EmptyLinesAreSkippedUnlessALineIsAnImage) {
  const TestFolder folder;
  const auto file = folder.Write("t.txt", "\n1\n# c\n2\n\n");
  EXPECT_EQ(ReadTable(file).size(), 2u);
  EXPECT_THAT(InputErrorOf([&] { ReadTable(file, EmptyLines::kRefuseBetweenRows); }),
              HasSubstr("t.txt:1: empty line"));
}

}  // namespace
}  // namespace lift_slam
