// `lift_slam synthesize`: what it writes can be run on, what it cannot do it says.
#include "apps/synthesize_command.h"

#include "apps/run_test_fixture.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/util/file.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

class SynthesizeCommand : public RunCommand {
 protected:
  Outcome Synthesize(const std::string& arguments) const {
    return RunProgram("synthesize --output " + (folder_ / "made").string() + " " + arguments);
  }
};

TEST_F(SynthesizeCommand, EveryLayoutIsRecognisedWithItsTruth) {
  const std::vector<std::tuple<std::string, std::string, SequenceFormat>> layouts = {
      {"kitti", "made/sequences/00", SequenceFormat::kKittiOdometry},
      {"tum", "made", SequenceFormat::kTumRgbd},
      {"euroc", "made", SequenceFormat::kEuroc}};
  for (const auto& [layout, folder, format] : layouts) {
    std::filesystem::remove_all(folder_ / "made");
    const Outcome outcome = Synthesize("--path room_loop --frames 3 --layout " + layout);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("sequence    " + (folder_ / folder).string() + "\n"));
    const auto sequence = OpenSequence((folder_ / folder).string());
    EXPECT_EQ(sequence->info().format, format);
    EXPECT_EQ(sequence->info().num_frames, 3);
    ASSERT_TRUE(sequence->info().ground_truth) << layout;
    EXPECT_EQ(sequence->info().ground_truth->poses.size(), 3U);
  }
}

TEST_F(SynthesizeCommand, FrameRateAndSeedCount) {
  const auto image = [&](const std::string& arguments) {
    std::filesystem::remove_all(folder_ / "made");
    EXPECT_EQ(Synthesize("--frames 2 " + arguments).exit_code, 0);
    return ReadText(folder_ / "made/sequences/00/image_0/000001.png");
  };
  const std::string first = image("");
  EXPECT_EQ(first, image("--seed 1 --frame-rate-hz 10"));
  EXPECT_NE(first, image("--seed 2"));
  EXPECT_NE(first, image("--frame-rate-hz 5"));
}

TEST_F(SynthesizeCommand, BadArgumentsAreOneSentence) {
  ExpectOneSentence(Synthesize("--path moon"), {"moon", "room_sway"});
  ExpectOneSentence(Synthesize("--layout zip"), {"zip", "euroc"});
  ExpectOneSentence(Synthesize("--frames 0"), {"--frames"});
  ExpectOneSentence(Synthesize("--frames 502"), {"street_drive ends after 50 s", "501 frames"});
  WriteTextAtomically(folder_ / "file", "x");
  ExpectOneSentence(RunProgram("synthesize --output " + (folder_ / "file").string()),
                    {"is a file"});
  ExpectOneSentence(RunProgram("synthesize --output " + folder_.string()), {"is not empty"});
}

}  // namespace
}  // namespace lift_slam
