// Whole benchmarks on small rendered trees of KITTI's and EuRoC's form.
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <map>
#include <set>
#include <thread>

#include "apps/run_test_fixture.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class BenchmarkCommand : public RunCommand {
 protected:
  // `lift_slam benchmark ARGUMENTS` with the smallest settings that still give a map.
  std::string Arguments(const std::string& what) const {
    return fmt::format("benchmark {} --data {} --output {} --systems default_orb orb_slam", what,
                       (folder_ / "data").string(), output_.string());
  }
  std::set<std::string> Finished() const {
    std::set<std::string> names;
    if (!fs::is_directory(output_ / "results")) return names;
    for (const fs::path& path : FilesIn(output_ / "results")) names.insert(path.filename());
    return names;
  }
};

TEST_F(BenchmarkCommand, RunsKittiAndListsWhatIsMissing) {
  Render(SequenceLayout::kKittiOdometry, 40);
  const Outcome outcome = RunProgram(Arguments("kitti") + " --runs 1 --jobs 2");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("missing     sequence 01 is not below"));
  EXPECT_THAT(outcome.output, HasSubstr("2 done now, 0 were done, 0 failed"));
  const std::string table = ReadText(output_ / "tables.md");
  EXPECT_THAT(table, HasSubstr("r_rel [deg/100 m]"));
  EXPECT_THAT(table, HasSubstr("**"));     // the best
  EXPECT_THAT(table, HasSubstr("11.54"));  // of the paper
  for (const char* name : {"tables.csv", "tables.tex", "tables.html"}) {
    EXPECT_TRUE(fs::is_regular_file(output_ / name)) << name;
  }
  const Outcome again = RunProgram(Arguments("kitti") + " --runs 1");
  EXPECT_THAT(again.output, HasSubstr("0 done now, 2 were done, 0 failed"));
}

TEST_F(BenchmarkCommand, RunsEurocJobByJob) {
  const fs::path written = Render(SequenceLayout::kEuroc, 40);
  fs::create_directories(folder_ / "moved");
  fs::rename(written, folder_ / "moved" / "MH_02_easy");
  fs::remove_all(folder_ / "data");
  fs::rename(folder_ / "moved", folder_ / "data");
  ASSERT_EQ(RunProgram(Arguments("plan euroc") + " --runs 1").exit_code, 0);
  EXPECT_TRUE(Finished().empty());
  for (const char* job : {"1", "2"}) {
    const Outcome outcome =
        RunProgram(fmt::format("benchmark run-job {} --output {}", job, output_.string()));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  }
  EXPECT_EQ(Finished().size(), 2U);
  const Outcome merged = RunProgram("benchmark merge --output " + output_.string());
  EXPECT_EQ(merged.exit_code, 0) << merged.output;
  EXPECT_THAT(merged.output, HasSubstr("MH_02"));
  ExpectOneSentence(RunProgram("benchmark run-job 3 --output " + output_.string()),
                    {"a number from 1 to 2"});
}

TEST_F(BenchmarkCommand, GoesOnAfterAKillAndRepeatsNothing) {
  Render(SequenceLayout::kKittiOdometry, 40);
  const std::string arguments = Arguments("kitti") + " --runs 3";
  {
    BackgroundProgram program(arguments, folder_ / "printed.txt");
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (Finished().empty() && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    program.Send(SIGKILL);
    EXPECT_EQ(program.Wait(), -SIGKILL);
  }
  const std::set<std::string> before = Finished();
  ASSERT_FALSE(before.empty());
  ASSERT_LT(before.size(), 6U);
  std::map<std::string, fs::file_time_type> times;
  for (const std::string& name : before) {
    times[name] = fs::last_write_time(output_ / "results" / name / "result.json");
  }
  const Outcome outcome = RunProgram(arguments);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr(fmt::format("{} done now, {} were done, 0 failed",
                                                    6 - before.size(), before.size())));
  EXPECT_EQ(Finished().size(), 6U);
  for (const auto& [name, time] : times) {
    EXPECT_EQ(fs::last_write_time(output_ / "results" / name / "result.json"), time);
  }
}

TEST_F(BenchmarkCommand, BadArgumentsAreExplained) {
  fs::create_directories(folder_ / "data");
  ExpectOneSentence(RunProgram(Arguments("kiti")), {"suite 'kiti' is unknown", "robustness"});
  ExpectOneSentence(RunProgram(Arguments("kitti")), {"nothing to run", "sequence 00"});
  ExpectOneSentence(RunProgram("benchmark kitti --output " + output_.string()), {"--data"});
}

}  // namespace
}  // namespace lift_slam
