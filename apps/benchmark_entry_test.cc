#include "apps/benchmark_entry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <deque>

#include "apps/benchmark_figures.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

// Runs of one system on a sequence, of which some have ended.
class BenchmarkEntry : public testing::Test {
 protected:
  BenchmarkEntry() { cell_.planned = 5; }

  void Add(RunStatus status, double coverage, double ate_m) {
    BenchmarkRun& run = runs_.emplace_back();
    run.status = status;
    run.coverage = coverage;
    run.figures[kAteFigure] = ate_m;
    cell_.runs.push_back(&run);
  }
  std::string Text(CellStatistic statistic = CellStatistic::kMean) const {
    return MakeEntry(&cell_, /*is_skipped=*/false, kAteFigure, statistic).text;
  }

  BenchmarkCell cell_;
  std::deque<BenchmarkRun> runs_;
};

TEST_F(BenchmarkEntry, IsNoFailureWhileRunsAreMissing) {
  EXPECT_EQ(Text(), "?");
  EXPECT_EQ(RunsText(cell_), "?");
  Add(RunStatus::kFailLost, 0.2, 9.0);
  EXPECT_EQ(Text(), "?");
  EXPECT_EQ(RunsText(cell_), "0/1 of 5");
  for (int i = 0; i < 4; ++i) Add(RunStatus::kFailInit, 0.0, 9.0);
  EXPECT_EQ(Text(), "X");
  EXPECT_EQ(RunsText(cell_), "0/5");
}

TEST_F(BenchmarkEntry, TellsFailedRunsFromThoseNotRunYet) {
  for (int i = 0; i < 3; ++i) Add(RunStatus::kOk, 1.0, 1.0 + i);
  EXPECT_EQ(Text(), "2.000 3/3 of 5");
  Add(RunStatus::kFailLost, 0.2, 9.0);
  EXPECT_EQ(Text(), "2.000 3/4 of 5");
  Add(RunStatus::kFailLost, 0.2, 9.0);
  EXPECT_EQ(Text(), "2.000 3/5");
  EXPECT_EQ(Text(CellStatistic::kRange), "1.000 to 3.000 3/5");
  EXPECT_FALSE(MakeEntry(&cell_, false, kAteFigure, CellStatistic::kMean).contender);
}

TEST_F(BenchmarkEntry, AllRunsMayWinAndPartialOnesMayNot) {
  for (int i = 0; i < 4; ++i) Add(RunStatus::kOk, 1.0, 1.0);
  Add(RunStatus::kOk, 1.0, 2.0);
  EXPECT_EQ(Text(), "1.200");
  EXPECT_TRUE(MakeEntry(&cell_, false, kAteFigure, CellStatistic::kMean).contender);
  runs_.back().status = RunStatus::kPartial;
  runs_.back().coverage = 0.5;
  EXPECT_EQ(Text(), "1.200 (90 %)");
  EXPECT_EQ(Text(CellStatistic::kRange), "1.000 to 2.000 (90 %)");
  EXPECT_FALSE(MakeEntry(&cell_, false, kAteFigure, CellStatistic::kMean).contender);
}

TEST(BenchmarkFigures, NotesNameWhatIsNotOfAllRuns) {
  BenchmarkPlan plan;
  plan.suite = "robustness";
  plan.titles = {"ours"};
  plan.sequences = {"06"};
  plan.conditions = {"none", "gamma=4"};
  std::vector<BenchmarkRun> runs;
  for (const std::string& condition : plan.conditions) {
    for (int seed = 0; seed < 2; ++seed) {
      BenchmarkJob job;
      job.title = "ours";
      job.sequence = "06";
      job.distortion = condition == "none" ? "" : condition;
      job.source = "/nonexistent";
      plan.jobs.push_back(job);
      BenchmarkRun run;
      run.title = "ours";
      run.sequence = "06";
      run.condition = condition;
      run.coverage = 1.0;
      const bool is_lost = condition == "gamma=4" && seed == 1;
      run.status = is_lost ? RunStatus::kFailLost : RunStatus::kOk;
      run.figures[kAteFigure] = 1.0;
      runs.push_back(run);
    }
  }
  const auto pictures = MakeBenchmarkPictures(plan, runs);
  ASSERT_EQ(pictures.size(), 1U);
  EXPECT_EQ(pictures[0].note, "Of a part of the runs or frames: ours, gamma=4 1/2.");
  plan.suite = "ablation";
  const auto variants = MakeBenchmarkPictures(plan, runs);
  ASSERT_EQ(variants.size(), 2U);
  EXPECT_EQ(variants[0].note, "Median of the runs; bar: least to largest.");
  EXPECT_THAT(variants[1].note, HasSubstr("largest. Of a part of the runs or frames: ours 1/2."));
}

}  // namespace
}  // namespace lift_slam
