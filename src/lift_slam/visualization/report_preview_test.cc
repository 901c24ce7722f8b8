#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "lift_slam/util/file.h"
#include "lift_slam/visualization/fake_run_for_test.h"
#include "lift_slam/visualization/report_html.h"

namespace lift_slam {
namespace {

// Writes the reports of made-up runs, to be looked at in a browser.
TEST(ReportPreview, WritesPagesWhenAFolderIsGiven) {
  const char* folder = std::getenv("LIFT_SLAM_PREVIEW_DIR");
  if (folder == nullptr) GTEST_SKIP() << "set LIFT_SLAM_PREVIEW_DIR to get the pages";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const FakeRunOptions& options, bool with_truth) {
    const FakeRun fake = MakeFakeRun(options);
    WriteTextAtomically(std::filesystem::path(folder) / name,
                        ReportHtml(fake.run, MakeFakeReportData(fake, with_truth)));
  };
  write("truth.html", {.num_frames = 420}, true);
  write("no_truth.html", {.num_frames = 160}, false);
  write("no_map.html", {.num_frames = 160, .num_maps = 0}, false);
  write("maps.html", {.num_frames = 600, .num_maps = 3}, false);
  write("maps_truth.html", {.num_frames = 600, .num_maps = 3}, true);
  write("five.html", {.num_frames = 5, .num_annotated = 2}, true);
  write("long.html", {.num_frames = 5000, .num_annotated = 30}, true);
}

}  // namespace
}  // namespace lift_slam
