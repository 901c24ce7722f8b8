#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "apps/program_for_test.h"
#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/testing/temporary_folder.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(WeightsCommand, InfoDescribesAFile) {
  const TemporaryFolder files;
  const std::filesystem::path path = files / "weights.safetensors";
  LiftWeights weights = RandomLiftWeights(LiftTopology::kT, 3);
  weights.distances = DistanceQuantiles{{0.1F, 0.2F, 0.3F, 0.4F, 0.5F}, {1, 2, 3, 4, 5}};
  WriteLiftWeights(weights, path);
  const Outcome outcome = RunProgram("weights info " + path.string());
  EXPECT_EQ(outcome.exit_code, 0);
  for (const std::string& part :
       {std::string("random"), weights.sha256, std::string("2019162 parameters"),
        std::string("0.1 0.2 0.3 0.4 0.5"), std::string("He initialisation, seed 3")}) {
    EXPECT_THAT(outcome.output, HasSubstr(part));
  }
}

TEST(WeightsCommand, BadInputIsOneSentence) {
  for (const char* arguments :
       {"weights", "weights info", "weights info /nonexistent.safetensors", "weights import a.h5",
        "weights import /nonexistent.h5 --output /tmp/x.safetensors",
        "weights import a.h5 --output b --descriptor G"}) {
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    EXPECT_THAT(outcome.output, StartsWith("lift_slam: ")) << arguments;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
}

TEST(WeightsCommand, ImportsWhatTheAuthorsReleased) {
  LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
  const TemporaryFolder files;
  const std::filesystem::path path = files / "weights.safetensors";
  const std::string folder = LiftReferenceFolder().string();
  const Outcome outcome =
      RunProgram("weights import " + folder + "/new-CNN3-picc-iter-56k.h5 " + folder +
                 "/tf-lift-release.h5 --descriptor T --detector noaug --matching 0.3 0.5 0.7 1 1.6 "
                 "--nearest-wrong 1.5 2 2.7 3 3.3 --output " +
                 path.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  const Outcome info = RunProgram("weights info " + path.string());
  EXPECT_THAT(info.output, HasSubstr("lift-released-T-kp_noaug"));
  EXPECT_THAT(info.output, HasSubstr("(grey - 110.7539) / 61.5368"));
  EXPECT_THAT(info.output, HasSubstr("none (upright patches)"));
  EXPECT_THAT(info.output, HasSubstr("0.3 0.5 0.7 1 1.6"));
}

}  // namespace
}  // namespace lift_slam
