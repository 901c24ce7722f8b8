#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "apps/program_for_test.h"
#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// Images of random blocks; image 2 i + 1 shows image 2 i a little moved.
void WriteImages(const std::filesystem::path& folder, int num_places) {
  std::filesystem::create_directories(folder);
  Random random(5);
  for (int i = 0; i < num_places; ++i) {
    cv::Mat blocks(30, 40, CV_8UC1), image;
    for (int y = 0; y < blocks.rows; ++y) {
      for (int x = 0; x < blocks.cols; ++x) {
        blocks.at<uchar>(y, x) = static_cast<uchar>(random.UniformInt(0, 255));
      }
    }
    cv::resize(blocks, image, cv::Size(400, 300), 0, 0, cv::INTER_NEAREST);
    const auto name = [&](int k) {
      return (folder / (std::to_string(2 * i + k) + ".png")).string();
    };
    cv::imwrite(name(0), image(cv::Rect(0, 0, 380, 280)));
    cv::imwrite(name(1), image(cv::Rect(13, 7, 380, 280)));
  }
}

// Without the lines that long work leaves: "12/12 frames in 0.1 s (96.0 frames/s), extracted".
std::string WithoutProgress(const std::string& output) {
  std::istringstream lines(output);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("frames/s)") == std::string::npos) kept += line + '\n';
  }
  return kept;
}

class VocabularyCommandTest : public testing::Test {
 protected:
  VocabularyCommandTest() { WriteImages(images_, 6); }

  Outcome Build(const std::string& more = "") const {
    return RunProgram("vocabulary build " + images_.string() +
                      " --branching 5 --depth 3 --output " + vocabulary_.string() + " " + more);
  }

  TemporaryFolder folder_;
  std::filesystem::path images_ = folder_ / "images";
  std::filesystem::path vocabulary_ = folder_ / "orb.vocabulary";
};

TEST_F(VocabularyCommandTest, BuildsDescribesAndRecognises) {
  const Outcome build = Build();
  ASSERT_EQ(build.exit_code, 0) << build.output;
  EXPECT_THAT(build.output, HasSubstr("of 12 images"));
  const Outcome info = RunProgram("vocabulary info " + vocabulary_.string());
  for (const char* part : {"orb (256 bits", "k = 5, L = 3", "level 3", "sources       12 images"}) {
    EXPECT_THAT(info.output, HasSubstr(part));
  }
  const Outcome query = RunProgram("vocabulary query " + vocabulary_.string() +
                                   " --best 1 --query " + (images_ / "4.png").string() + " " +
                                   (images_ / "7.png").string() + " --among " + images_.string());
  EXPECT_EQ(query.exit_code, 0) << query.output;
  EXPECT_THAT(query.output, HasSubstr("1.0000"));  // itself
  const Outcome others = RunProgram("vocabulary query " + vocabulary_.string() +
                                    " --best 1 --query " + images_.string());
  EXPECT_THAT(others.output, HasSubstr("0.png\n"));
  EXPECT_THAT(others.output, testing::ContainsRegex("/8\\.png\n  [0-9. ]+words +[^ ]*/9\\.png\n"));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_THAT(entry.path().filename().string(), testing::AnyOf("images", "orb.vocabulary"));
  }
}

TEST_F(VocabularyCommandTest, SameBytesAgainAndFromKeptDescriptors) {
  const std::string keep = "--descriptors " + (folder_ / "kept").string();
  ASSERT_EQ(Build(keep).exit_code, 0);
  const std::string first = ReadText(vocabulary_);
  ASSERT_EQ(Build(keep + " --threads 1").exit_code, 0);
  EXPECT_TRUE(ReadText(vocabulary_) == first);
  const Outcome other = Build(keep + " --step 2");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_THAT(other.output, HasSubstr("other images, options or weights"));
}

TEST_F(VocabularyCommandTest, UnreadableImageIsLeftOutWithAWarning) {
  WriteTextAtomically(images_ / "5.png", "no picture");
  const Outcome build = Build();
  EXPECT_EQ(build.exit_code, 0);
  EXPECT_THAT(build.output, HasSubstr("warning: " + (images_ / "5.png").string() + ": left out"));
}

TEST_F(VocabularyCommandTest, LinksInACircleAndToNothingAreLeftOut) {
  std::filesystem::create_directory_symlink(".", images_ / "again");
  std::filesystem::create_symlink("nothing.png", images_ / "dangling.png");
  const Outcome build = Build();
  EXPECT_EQ(build.exit_code, 0) << build.output;
  EXPECT_THAT(build.output, HasSubstr("of 12 images"));
  EXPECT_THAT(build.output, HasSubstr("warning: " + (images_ / "dangling.png").string() +
                                      ": left out: No such file or directory\n"));
}

TEST_F(VocabularyCommandTest, BadInputIsOneSentence) {
  ASSERT_EQ(Build().exit_code, 0);
  const std::string vocabulary = vocabulary_.string(), image = (images_ / "0.png").string();
  WriteTextAtomically(folder_ / "foreign", "%YAML:1.0");
  WriteTextAtomically(folder_ / "truncated", ReadText(vocabulary_).substr(0, 5000));
  const std::filesystem::path weights = folder_ / "weights.safetensors";
  LiftWeights random_weights = RandomLiftWeights(LiftTopology::kT, 3);
  WriteLiftWeights(random_weights, weights);
  const std::string output = " --output " + (folder_ / "x").string();
  for (const auto& [arguments, part] : std::vector<std::pair<std::string, std::string>>{
           {"vocabulary info /nonexistent", "no such file"},
           {"vocabulary info " + (folder_ / "foreign").string(), "no vocabulary"},
           {"vocabulary info " + (folder_ / "truncated").string(), "truncated"},
           {"vocabulary query " + vocabulary + " --query " + image + " --weights " +
                weights.string() + " --upright",
            "not for 'lift:"},
           {"vocabulary query " + vocabulary + " --query /nonexistent", "no such file or folder"},
           {"vocabulary build " + image + output + " --max-features 20", "too few descriptors"},
           {"vocabulary build " + vocabulary + output, "is no image"},
           {"vocabulary build " + image + output + " --features lift --weights none", "none"},
           {"vocabulary build " + image + output + " --branching 1", "branching"},
           {"vocabulary build " + image, "--output"},
       }) {
    const Outcome outcome = RunProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << arguments;
    const std::string sentence = WithoutProgress(outcome.output);
    EXPECT_THAT(sentence, StartsWith("lift_slam: ")) << arguments;
    EXPECT_THAT(sentence, HasSubstr(part)) << arguments;
    EXPECT_EQ(std::count(sentence.begin(), sentence.end(), '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace lift_slam
