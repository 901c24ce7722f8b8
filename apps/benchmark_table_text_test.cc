#include "apps/benchmark_table_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/visualization/xml_check_for_test.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

ResultTable Ate() {
  return {"ATE RMSE [m]",
          {"00", "MH_01"},
          {{"ours", {{"1.5", 1.5, true}, {"X", {}}}}, {"a|b <c>", {{"2.0 (72 %)", {}}, {"-", {}}}}},
          {{"ORB-SLAM", {{"11.54", {}}, {"0.048", {}}}, "paper, Table 2"}}};
}

ResultTable Drift() {
  return {"t_rel [%]", {"00", "MH_01"}, {{"ours", {{"0.7", {}}, {"n/a", {}}}}}, {}};
}

TEST(BenchmarkTableText, MarkdownMarksTheBestAndNamesTheSource) {
  const std::string text = MarkdownTable(Ate());
  EXPECT_THAT(text, HasSubstr("| ATE RMSE [m] | 00 | MH_01 |\n| --- | ---: | ---: |\n"));
  EXPECT_THAT(text, HasSubstr("| ours | **1.5** | X |\n"));
  EXPECT_THAT(text, HasSubstr("| a\\|b <c> | 2.0 (72 %) | - |\n"));
  EXPECT_THAT(text, HasSubstr("| ORB-SLAM [paper, Table 2] | 11.54 | 0.048 |\n"));
}

TEST(BenchmarkTableText, HtmlIsWellFormedWithOneHeadingASource) {
  ResultTable table = Ate();
  table.others.push_back({"DeepVO", {{"-", {}}, {"-", {}}}, "another"});
  const std::string html = HtmlTable(table);
  EXPECT_EQ(XmlProblem(html, /*html=*/true), "");
  EXPECT_THAT(html, HasSubstr("<b>1.5</b>"));
  EXPECT_THAT(html, HasSubstr("a|b &lt;c&gt;"));
  EXPECT_THAT(html, HasSubstr("colspan=\"3\">paper, Table 2<"));
  EXPECT_THAT(html, HasSubstr("colspan=\"3\">another<"));
}

TEST(BenchmarkTableText, LatexIsEscaped) {
  const std::string text = LatexTable(Ate());
  EXPECT_THAT(text, HasSubstr("\\begin{tabular}{lrr}\n"));
  EXPECT_THAT(text, HasSubstr("ATE RMSE [m] & 00 & MH\\_01 \\\\\n"));
  EXPECT_THAT(text, HasSubstr("ours & \\textbf{1.5} & X \\\\\n"));
  EXPECT_THAT(text, HasSubstr("2.0 (72 \\%)"));
}

TEST(BenchmarkTableText, LatexByRowHasALineAFigureAndTheTitleOnce) {
  const std::string text = LatexTableByRow({Ate(), Drift()});
  EXPECT_THAT(text, HasSubstr("ours & ATE RMSE [m] & \\textbf{1.5} & X \\\\\n"
                              " & t\\_rel [\\%] & 0.7 & n/a \\\\\n\\hline\n"));
  EXPECT_THAT(text, HasSubstr("ORB-SLAM [paper, Table 2] & ATE RMSE [m] & 11.54"));
}

TEST(BenchmarkTableText, LatexByColumnHasAColumnAFigureOfEachSystem) {
  const std::string text = LatexTableByColumn({Transposed(Ate()), Transposed(Drift())});
  EXPECT_THAT(text, HasSubstr("& \\multicolumn{2}{c}{ours}"));
  EXPECT_THAT(text, HasSubstr("00 & \\textbf{1.5} & 0.7 & 2.0 (72 \\%) & - & 11.54 & - \\\\\n"));
}

TEST(BenchmarkTableText, TransposedKeepsTheMarks) {
  const ResultTable table = Transposed(Ate());
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_EQ(table.columns[2], "ORB-SLAM [paper, Table 2]");
  ASSERT_EQ(table.ours.size(), 2U);
  EXPECT_EQ(table.ours[1].title, "MH_01");
  EXPECT_TRUE(table.ours[0].entries[0].is_bold);
}

}  // namespace
}  // namespace lift_slam
