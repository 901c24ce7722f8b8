#include "lift_slam/visualization/report_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lift_slam/visualization/fake_run_for_test.h"
#include "lift_slam/visualization/time_summary.h"

namespace lift_slam {
namespace {

TEST(ReportScene, WithoutTruthEachMapIsAPathInItsOwnUnits) {
  const FakeRun fake = MakeFakeRun({.num_frames = 120, .num_maps = 2});
  const ReportScene scene(fake.run, ReportData());
  EXPECT_FALSE(scene.aligned());
  EXPECT_EQ(scene.UpLabel(), "z [map units]");
  ASSERT_EQ(scene.paths().size(), 2U);
  EXPECT_TRUE(scene.Shows(scene.paths()[1], 1));
  EXPECT_FALSE(scene.Shows(scene.paths()[1], 0));
  EXPECT_TRUE(scene.truth().empty());
}

TEST(ReportScene, AlignedRunIsOnePathInMetresWithAGapWhereItWasLost) {
  const FakeRun fake = MakeFakeRun({.num_frames = 120, .num_maps = 2});
  const ReportScene scene(fake.run, MakeFakeReportData(fake, true));
  ASSERT_EQ(scene.paths().size(), 1U);
  EXPECT_EQ(scene.RightLabel(), "x [m]");
  const ScenePath& path = scene.paths()[0];
  EXPECT_NEAR(path.up.back(), fake.truth.back().world_from_cam.translation.z(), 2.0);
  int gaps = 0;
  for (const double x : path.right) gaps += std::isnan(x) ? 1 : 0;
  EXPECT_GE(gaps, 1);
}

TEST(ReportScene, HeightPointsUpInBothViews) {
  const FakeRun fake = MakeFakeRun({.num_frames = 20});
  const Eigen::Vector3d x_in_map(1.0, 2.0, 3.0);
  EXPECT_EQ(ReportScene(fake.run, ReportData()).OnPage(x_in_map), Eigen::Vector3d(1.0, 3.0, -2.0));
  ReportData z_up;
  z_up.ground_truth_view = TopView::kXY;
  z_up.truth_from_map = Sim3d();
  EXPECT_EQ(ReportScene(fake.run, z_up).OnPage(x_in_map), x_in_map);
}

TEST(ReportScene, TruthByFrameIndexTakesTheTimesOfTheFrames) {
  const FakeRun fake = MakeFakeRun({.num_frames = 50});
  ReportData data = MakeFakeReportData(fake, true);
  for (TrajectoryPose& pose : data.ground_truth) pose.timestamp_ns = 0;
  data.ground_truth.push_back(data.ground_truth.back());
  data.ground_truth.back().frame_index = 5000;  // beyond the run
  const ReportScene scene(fake.run, data);
  ASSERT_EQ(scene.truth().time_s.size(), 50U);
  EXPECT_DOUBLE_EQ(scene.truth().time_s[10], 1.0);
}

TEST(ReportScene, TruthByTimeIsCutToTheRun) {
  const FakeRun fake = MakeFakeRun({.num_frames = 50});
  ReportData data = MakeFakeReportData(fake, true);
  data.ground_truth = MakeFakeRun({.num_frames = 500}).truth;
  for (TrajectoryPose& pose : data.ground_truth) pose.frame_index = -1;
  const ReportScene scene(fake.run, data);
  EXPECT_LE(scene.truth().time_s.back(), scene.duration_s() + 0.5);
  EXPECT_GE(scene.truth().time_s.size(), 50U);
}

TEST(TimeSummary, GivesMedianMeanAndPercentile) {
  std::vector<double> times_ms;
  for (int i = 100; i >= 1; --i) times_ms.push_back(i);
  const TimeSummary summary = SummarizeTimes(times_ms);
  EXPECT_DOUBLE_EQ(summary.median_ms, 50.5);
  EXPECT_DOUBLE_EQ(summary.mean_ms, 50.5);
  EXPECT_DOUBLE_EQ(summary.p95_ms, 95.0);
  EXPECT_DOUBLE_EQ(summary.max_ms, 100.0);
  EXPECT_DOUBLE_EQ(summary.total_s, 5.05);
  EXPECT_EQ(SummarizeTimes({}).runs, 0U);
  EXPECT_DOUBLE_EQ(SummarizeTimes({7.0}).p95_ms, 7.0);
}

}  // namespace
}  // namespace lift_slam
