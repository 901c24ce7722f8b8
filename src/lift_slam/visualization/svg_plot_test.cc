#include "lift_slam/visualization/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lift_slam/visualization/axis.h"
#include "lift_slam/visualization/plot_layout.h"
#include "lift_slam/visualization/polyline.h"
#include "lift_slam/visualization/xml_check_for_test.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(EscapeXml, ReplacesMarkupControlAndBrokenBytes) {
  EXPECT_EQ(EscapeXml("a<b>&\"'"), "a&lt;b&gt;&amp;&quot;&#39;");
  EXPECT_EQ(EscapeXml(std::string("a\x01\0b", 4)), "ab");
  EXPECT_EQ(EscapeXml("caf\xC3\xA9"), "caf\xC3\xA9");
  EXPECT_EQ(EscapeXml("x\xFFy\xC3"), "x\xEF\xBF\xBDy\xEF\xBF\xBD");
  EXPECT_EQ(EscapeXml("\xC0\xBC"), "\xEF\xBF\xBD\xEF\xBF\xBD") << "an overlong '<'";
}

TEST(Base64, AgreesWithTheExamplesOfTheStandard) {
  EXPECT_EQ(Base64("", 0), "");
  EXPECT_EQ(Base64("f", 1), "Zg==");
  EXPECT_EQ(Base64("fo", 2), "Zm8=");
  EXPECT_EQ(Base64("foobar", 6), "Zm9vYmFy");
}

TEST(FormatNumber, KeepsSignificantDigits) {
  EXPECT_EQ(FormatNumber(0.0), "0");
  EXPECT_EQ(FormatNumber(12345.678), "12346");
  EXPECT_EQ(FormatNumber(3.14159), "3.142");
  EXPECT_EQ(FormatNumber(0.0312, 3), "0.0312");
  EXPECT_EQ(FormatNumber(-2.5),
            "\xE2\x88\x92"
            "2.5");
  EXPECT_EQ(FormatNumber(kNan), "n/a");
}

TEST(Axis, TicksAreRoundAndInsideTheRange) {
  const AxisTicks ticks = MakeTicks({-0.3, 1.7, false}, 6);
  EXPECT_DOUBLE_EQ(ticks.step, 0.5);
  EXPECT_THAT(ticks.labels, ElementsAre("0", "0.5", "1.0", "1.5"));
}

TEST(Axis, IntegersHaveNoFractions) {
  EXPECT_THAT(MakeTicks({-0.5, 4.5, false}, 12, /*integers=*/true).labels,
              ElementsAre("0", "1", "2", "3", "4"));
}

TEST(Axis, NegativeLabelsHaveAMinusSign) {
  EXPECT_THAT(MakeTicks({-20.0, 0.0, false}, 3).labels, ElementsAre("\xE2\x88\x92"
                                                                    "20",
                                                                    "\xE2\x88\x92"
                                                                    "10",
                                                                    "0"));
}

TEST(Axis, ASingleValueGetsARoundRangeAroundIt) {
  AxisRange range;
  range.Add(kNan);
  EXPECT_TRUE(range.empty);
  range.Add(5.0);
  const AxisRange grown = GrownToTicks(range, 5);
  EXPECT_LT(grown.min, 5.0);
  EXPECT_GT(grown.max, 5.0);
}

TEST(Polyline, ThinningKeepsThePeakAndTheEnds) {
  PixelLine line;
  for (int i = 0; i < 10'000; ++i) {
    line.x.push_back(0.01 * i);
    line.y.push_back(i == 4321 ? 500.0 : 10.0);
  }
  const PixelLine thin = ThinnedOut(line);
  EXPECT_LT(thin.x.size(), 500U);
  EXPECT_THAT(thin.y, testing::Contains(500.0));
  EXPECT_DOUBLE_EQ(thin.x.front(), line.x.front());
  EXPECT_DOUBLE_EQ(thin.x.back(), line.x.back());
}

TEST(Polyline, ThinningKeepsTheShapeOfAClosedPath) {
  PixelLine circle;
  for (int i = 0; i <= 20'000; ++i) {
    circle.x.push_back(100.0 * std::cos(i * 2e-4 * M_PI));
    circle.y.push_back(100.0 * std::sin(i * 2e-4 * M_PI));
  }
  const PixelLine thin = ThinnedOut(circle);
  EXPECT_LT(thin.x.size(), 200U);
  for (std::size_t i = 1; i < thin.x.size(); ++i) {
    const double middle_x = 0.5 * (thin.x[i] + thin.x[i - 1]);
    const double middle_y = 0.5 * (thin.y[i] + thin.y[i - 1]);
    EXPECT_NEAR(std::hypot(middle_x, middle_y), 100.0, 0.15);
  }
  EXPECT_DOUBLE_EQ(thin.x.front(), circle.x.front());
  EXPECT_DOUBLE_EQ(thin.x.back(), circle.x.back());
}

TEST(Polyline, OfAStraightStretchOnlyTheEndsStay) {
  PixelLine corner;
  for (int i = 0; i <= 100; ++i) {
    corner.x.push_back(200.0 - std::max(0, i - 50) - 2.0 * std::min(i, 50));
    corner.y.push_back(std::max(0, i - 50));
  }
  const PixelLine thin = ThinnedOut(corner);
  EXPECT_EQ(thin.x, (std::vector<double>{200.0, 100.0, 50.0}));
  EXPECT_EQ(thin.y, (std::vector<double>{0.0, 0.0, 50.0}));
}

TEST(Polyline, AGapStartsANewStretchAndALonePointIsADot) {
  const PixelLine line = {{0.0, 1.0, 2.0, 3.0, 4.0}, {0.0, 1.0, kNan, 3.0, kNan}};
  EXPECT_EQ(SvgPathData(line), "M0.0 0.0L1.0 1.0M3.0 3.0h0");
}

TEST(PlotLayout, EqualAspectGivesBothAxesTheSameScale) {
  Plot plot;
  plot.equal_aspect = true;
  plot.series.push_back({"path", SeriesKind::kLine, PlotColor::kBlue, {0.0, 100.0}, {0.0, 3.0}});
  const PlotLayout layout = LayOut(plot);
  EXPECT_NEAR(layout.x_range.length() / layout.width, layout.y_range.length() / layout.height,
              1e-9);
  EXPECT_LE(layout.y_range.min, 0.0);
  EXPECT_GE(layout.x_range.max, 100.0);
}

TEST(PlotLayout, LongLegendGoesToTheNextRow) {
  Plot plot;
  plot.width_px = 300;
  for (const char* name : {"a rather long name of a line", "another long name", "and one more"}) {
    plot.series.push_back({name, SeriesKind::kLine, PlotColor::kBlue, {0.0, 1.0}, {0.0, 1.0}});
  }
  const PlotLayout layout = LayOut(plot);
  EXPECT_GT(layout.legend[1].y, layout.legend[0].y);
  EXPECT_GT(layout.top, layout.legend[2].y);
}

Plot PlotWithEverything() {
  Plot plot;
  plot.description = "a < b & \"c\"";
  plot.x.label = "time <s>";
  plot.y.label = "error [m]";
  plot.bands = {{"lost & gone", PlotColor::kVermilion, 1.0, 2.0, true}};
  plot.levels = {{"mean", PlotColor::kInk, 0.5}};
  const std::vector<double> x = {0.0, 1.0, 2.0, 3.0};
  for (const SeriesKind kind :
       {SeriesKind::kLine, SeriesKind::kPoints, SeriesKind::kRings, SeriesKind::kStackedBars,
        SeriesKind::kStackedBars, SeriesKind::kRug}) {
    plot.series.push_back({"series <1>", kind, PlotColor::kBlue, x, {1.0, kNan, 0.5, 0.2}});
  }
  return plot;
}

TEST(SvgPlot, IsWellFormedAndEscapesText) {
  const std::string svg = RenderSvgFile(PlotWithEverything());
  EXPECT_EQ(XmlProblem(svg), "");
  EXPECT_THAT(svg, HasSubstr("time &lt;s&gt;"));
  EXPECT_THAT(svg, HasSubstr("lost &amp; gone"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPlot, WithoutAnyDataIsStillAFrameWithAxes) {
  Plot plot;
  plot.series.push_back({"empty", SeriesKind::kLine, PlotColor::kBlue, {}, {}});
  plot.series.push_back({"bars", SeriesKind::kStackedBars, PlotColor::kBlue, {}, {}});
  const std::string svg = RenderSvg(plot);
  EXPECT_EQ(XmlProblem(svg), "");
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, HasSubstr("p-frame"));
}

TEST(SvgPlot, StackedBarsStandOnOneAnother) {
  Plot plot;
  plot.series.push_back({"a", SeriesKind::kStackedBars, PlotColor::kBlue, {0.0, 1.0}, {3.0, 1.0}});
  plot.series.push_back({"b", SeriesKind::kStackedBars, PlotColor::kSky, {0.0, 1.0}, {4.0, 1.0}});
  EXPECT_GE(LayOut(plot).y_range.max, 7.0);
}

}  // namespace
}  // namespace lift_slam
