#include "lift_slam/visualization/report_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lift_slam/visualization/fake_run_for_test.h"
#include "lift_slam/visualization/xml_check_for_test.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string FakeReport(const FakeRunOptions& options, bool with_truth) {
  const FakeRun fake = MakeFakeRun(options);
  return ReportHtml(fake.run, MakeFakeReportData(fake, with_truth));
}

TEST(ReportHtml, HasEverySectionAndIsWellFormed) {
  const std::string html = FakeReport({.num_frames = 80}, true);
  EXPECT_EQ(XmlProblem(html, /*html=*/true), "");
  for (const char* id : {"status", "trajectory", "tracking", "time", "map", "frames", "numbers",
                         "background", "viewer"}) {
    EXPECT_THAT(html, HasSubstr(std::string("id=\"") + id + "\"")) << id;
  }
  EXPECT_THAT(html, HasSubstr("ground truth"));
  EXPECT_THAT(html, HasSubstr("error [m]"));
  EXPECT_THAT(html, HasSubstr("max_features: 2000")) << "configuration";
}

TEST(ReportHtml, RefersToNothingOutside) {
  const std::string html = FakeReport({.num_frames = 80, .num_maps = 2}, true);
  for (const std::string attribute : {"src=\"", "href=\""}) {
    for (std::size_t i = html.find(attribute); i != std::string::npos;
         i = html.find(attribute, i + 1)) {
      EXPECT_EQ(html.compare(i + attribute.size(), 5, "data:"), 0) << html.substr(i, 80);
    }
  }
  for (const char* loader : {"url(", "@import", "fetch(", "XMLHttpRequest", "<link", "import("}) {
    EXPECT_THAT(html, Not(HasSubstr(loader)));
  }
}

TEST(ReportHtml, TextFromOutsideIsEscaped) {
  const FakeRun fake = MakeFakeRun({.num_frames = 20});
  ReportData data = MakeFakeReportData(fake, false);
  data.sequence = "<script>alert(1)</script>";
  data.configuration = "</pre><b>";
  const std::string html = ReportHtml(fake.run, data);
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("</pre><b>")));
  EXPECT_EQ(XmlProblem(html, /*html=*/true), "");
}

TEST(ReportHtml, PlacesAreDrawnAndListedWithTheirReasons) {
  FakeRun fake = MakeFakeRun({.num_frames = 120});
  PlaceEvent loop;
  loop.frame_index = 110;
  loop.other_frame_index = 20;
  loop.num_inliers = 87;
  PlaceEvent refused = loop;
  refused.rejection = PlaceRejection::kFewFound;
  fake.run.place_events = {refused, loop};
  const std::string html = ReportHtml(fake.run, MakeFakeReportData(fake, true));
  EXPECT_EQ(XmlProblem(html, /*html=*/true), "");
  EXPECT_THAT(html, HasSubstr("Places seen before"));
  EXPECT_THAT(html, HasSubstr(">loop</text>")) << "legend";
  EXPECT_THAT(html, HasSubstr("only some texture repeats itself"));
}

TEST(ReportHtml, SaysWhyPlacesWereNotRecognised) {
  FakeRun fake = MakeFakeRun({.num_frames = 30});
  fake.run.place_recognition_notice = "no vocabulary for 'lift' & co";
  const std::string html = ReportHtml(fake.run, MakeFakeReportData(fake, true));
  EXPECT_EQ(XmlProblem(html, /*html=*/true), "");
  EXPECT_THAT(html, HasSubstr("no vocabulary for"));
}

TEST(ReportHtml, WithoutTruthSaysMapUnitsAndShowsNoError) {
  const std::string html = FakeReport({.num_frames = 60}, false);
  EXPECT_THAT(html, HasSubstr("z [map units]"));
  EXPECT_THAT(html, Not(HasSubstr("error [m]")));
  EXPECT_THAT(html, Not(HasSubstr("ground truth")));
}

TEST(ReportHtml, WithoutAMapSaysWhy) {
  const std::string html = FakeReport({.num_frames = 60, .num_maps = 0}, false);
  EXPECT_EQ(XmlProblem(html, /*html=*/true), "");
  EXPECT_THAT(html, HasSubstr("No map was made"));
  EXPECT_THAT(html, HasSubstr("The camera has hardly moved"));
  EXPECT_THAT(html, HasSubstr("FAILED"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"viewer\"")));
}

TEST(ReportHtml, SeveralMapsAreShownOneByOneWhenNotAligned) {
  const std::string html = FakeReport({.num_frames = 120, .num_maps = 3}, false);
  for (const char* title : {"Map 1 from above", "Map 2 from above", "Map 3 from above"}) {
    EXPECT_THAT(html, HasSubstr(title));
  }
  EXPECT_THAT(html, HasSubstr("not connected"));
}

TEST(ReportHtml, NoFrameAtAllIsStillAPage) {
  ReportData data;
  data.status = ReportStatus::kFailed;
  EXPECT_EQ(XmlProblem(ReportHtml(RunRecord(), data), /*html=*/true), "");
}

TEST(ReportHtml, FiveFramesWork) {
  EXPECT_EQ(XmlProblem(FakeReport({.num_frames = 5, .num_annotated = 2}, true), true), "");
}

TEST(ReportHtml, ManyFramesStayBelowThreeMegabytes) {
  const std::string html = FakeReport({.num_frames = 5000, .num_annotated = 40}, true);
  EXPECT_LT(html.size(), 3'000'000U);
  EXPECT_THAT(html, Not(HasSubstr("nan,"))) << "a number that is none in a plot";
}

}  // namespace
}  // namespace lift_slam
