#include "lift_slam/visualization/dot_chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/visualization/plain_svg.h"
#include "lift_slam/visualization/xml_check_for_test.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t Count(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

DotChart TwoSystems() {
  DotChart chart;
  chart.description = "errors <by> condition";
  chart.axis.label = "ATE RMSE [m]";
  chart.categories = {"none", "gamma=4", "q1 & q3"};
  chart.series = {{"ORB", PlotColor::kVermilion, {1.0, DotSeries::kFailed, 2.0}},
                  {"LIFT", PlotColor::kBlue, {0.5, 0.75, DotSeries::kNone}}};
  return chart;
}

TEST(DotChart, IsWellFormedAndNamesEverything) {
  const std::string svg = RenderSvg(TwoSystems());
  EXPECT_EQ(XmlProblem(svg), "");
  for (const char* text : {"errors &lt;by&gt; condition", "q1 &amp; q3", ">gamma=4<",
                           ">ATE RMSE [m]<", ">ORB<", ">LIFT<", ">failed<"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
  EXPECT_THAT(RenderSvgFile(TwoSystems()), HasSubstr("<style>"));
}

TEST(DotChart, DrawsADotANumberAndACrossAFailure) {
  const std::string svg = RenderSvg(TwoSystems());
  EXPECT_EQ(Count(svg, "<circle"), 2U + 4U);  // legend and numbers
  EXPECT_EQ(Count(svg, "stroke-width=\"2\""), 1U);
}

TEST(DotChart, DrawsABarWhereThereAreEndsAndMakesRoomForIt) {
  DotChart chart = TwoSystems();
  chart.series[1].low = {0.25, DotSeries::kNone, 0.5};
  chart.series[1].high = {40.0, DotSeries::kNone, 0.5};
  const std::string svg = RenderSvg(chart);
  EXPECT_EQ(Count(svg, "stroke-width=\"2\""), 1U + 1U);  // no bar without a dot
  EXPECT_THAT(svg, HasSubstr(">40<"));
}

TEST(DotChart, PlainFileHasTheColoursOfLightPagesInsteadOfVariables) {
  const std::string svg = PlainSvg(RenderSvgFile(TwoSystems()));
  EXPECT_THAT(svg, Not(HasSubstr("var(")));
  EXPECT_THAT(svg, HasSubstr(".p-s1{stroke:#0072b2}"));
  EXPECT_EQ(XmlProblem(svg), "");
  EXPECT_EQ(PlainSvg("<svg/>"), "<svg/>");
}

TEST(DotChart, LeavesNoRoomForFailuresWithoutOne) {
  DotChart chart = TwoSystems();
  chart.series[0].values[1] = 3.0;
  EXPECT_THAT(RenderSvg(chart), Not(HasSubstr("failed")));
}

TEST(DotChart, WithoutNumbersIsStillAChart) {
  DotChart chart;
  chart.categories = {"none"};
  chart.series = {{"ORB", PlotColor::kBlue, {}}};
  EXPECT_EQ(XmlProblem(RenderSvg(chart)), "");
}

}  // namespace
}  // namespace lift_slam
