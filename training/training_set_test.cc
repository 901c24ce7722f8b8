#include "training/training_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>

#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/lift/patch_cutter.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "training/patch_sampler.h"
#include "training/training_log.h"
#include "training/training_set_writer.h"
#include "training/word_list.h"

namespace lift_slam::training {
namespace {

using testing::HasSubstr;

// Smooth enough that a fraction of a pixel changes values little, and never the same twice.
GrayImage TestImage(int width, int height, int phase) {
  cv::Mat mat(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double value =
          128 + 60 * std::sin(0.11 * x + phase) + 60 * std::cos(0.07 * y - 0.03 * x);
      mat.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(value);
    }
  }
  return GrayImage(mat);
}

void WriteSet(const std::filesystem::path& folder) {
  TrainingSetWriter writer(folder);
  writer.AddImage(TestImage(320, 240, 0), {"a", "scene", "test", "CC0-1.0", "nobody"});
  writer.AddImage(TestImage(301, 203, 1), {"b", "scene", "test", "CC0-1.0", "nobody"});
  const View late[] = {{1, 100.25F, 90.5F, 3.0F}};
  const View early[] = {{0, 150.0F, 120.0F, 2.0F}, {1, 130.0F, 100.0F, 2.5F}};
  writer.AddPoint(late);
  writer.AddPoint(early);
  writer.AddEmptyPlace({1, 50.0F, 60.0F, 2.0F});
  writer.Finish("test");
}

std::string ErrorOf(const std::filesystem::path& folder) {
  try {
    TrainingSet set(folder);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TrainingSet, ReadsWhatWasWritten) {
  const TemporaryFolder folder;
  WriteSet(folder.path());
  const TrainingSet set(folder.path());
  ASSERT_EQ(set.num_images(), 2U);
  EXPECT_EQ(set.origin(1).name, "b");
  EXPECT_EQ(set.origin(1).licence, "CC0-1.0");
  const ImagePyramid expected = BuildPyramid(TestImage(301, 203, 1), kTrainingPyramid);
  ASSERT_EQ(set.pyramid(1).size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(cv::norm(set.pyramid(1)[i].image.mat(), expected[i].image.mat(), cv::NORM_INF), 0.0);
    EXPECT_DOUBLE_EQ(set.pyramid(1)[i].scale_x, expected[i].scale_x);
  }
  ASSERT_EQ(set.num_points(), 2U);
  EXPECT_EQ(set.views(0).size(), 2U) << "points are sorted by the image of their first view";
  EXPECT_EQ(set.views(0)[1].image, 1U);
  EXPECT_FLOAT_EQ(set.views(1)[0].x, 100.25F);
  EXPECT_EQ(set.NeighboursInImage(1), std::pair(std::size_t{1}, std::size_t{2}));
  EXPECT_EQ(set.empty_places().size(), 1U);
}

TEST(TrainingSet, RefusesWhatIsMissingOrDamaged) {
  const TemporaryFolder folder;
  EXPECT_THAT(ErrorOf(folder / "nothing"), HasSubstr("there is no such training set"));
  WriteSet(folder.path());
  std::filesystem::resize_file(folder / "images.bin", 5000);
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("ends in the middle of an image"));
  WriteSet(folder.path());
  std::filesystem::resize_file(folder / "views.bin", 33);
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("views.bin"));
  WriteSet(folder.path());
  std::filesystem::remove(folder / "manifest.json");
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("manifest.json"));
}

// Replaces the bytes at `at` by those of a value.
template <class T>
void Overwrite(const std::filesystem::path& path, std::size_t at, const T& value) {
  std::string bytes = ReadText(path);
  std::memcpy(&bytes[at], &value, sizeof value);
  WriteTextAtomically(path, bytes);
}

TEST(TrainingSet, RefusesImagesOfImpossibleSize) {
  const TemporaryFolder folder;
  for (const std::uint32_t side : {65536U, 1U << 31, 0U}) {  // the product of ints may be 0
    WriteSet(folder.path());
    Overwrite(folder / "images.bin", 4, std::array{side, side});
    EXPECT_THAT(ErrorOf(folder.path()), HasSubstr(side == 0 ? "without width or height"
                                                            : "ends in the middle of an image"));
  }
}

TEST(TrainingSet, RefusesViewsOutsideTheirImage) {
  const TemporaryFolder folder;
  for (const float value : {std::nanf(""), -5.0F, 350.0F, 1e30F}) {
    for (const std::size_t at : {4U, 8U}) {  // x and y
      WriteSet(folder.path());
      Overwrite(folder / "views.bin", at, value);
      EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("lies outside its image")) << value;
    }
  }
}

TEST(TrainingSet, RefusesPointsThatAreNotSortedByImage) {
  const TemporaryFolder folder;
  WriteSet(folder.path());
  Overwrite(folder / "views.bin", 0, std::uint32_t{1});
  Overwrite(folder / "views.bin", 2 * sizeof(View), std::uint32_t{0});
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("not sorted by the image"));
}

TEST(TrainingSet, RefusesAnotherFormat) {
  const TemporaryFolder folder;
  WriteSet(folder.path());
  folder.Write("manifest.json", R"({"format": "other"})");
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("format is \"other\", expected"));
  folder.Write("manifest.json",
               "{\"format\":" + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}");
  EXPECT_THAT(ErrorOf(folder.path()), HasSubstr("format is array, expected"));
}

TEST(TrainingSetWriter, KeepsTheOldSetUntilTheNewOneIsFinished) {
  const TemporaryFolder folder;
  WriteSet(folder.path());
  {
    TrainingSetWriter given_up(folder.path());
    given_up.AddImage(TestImage(100, 100, 0), {});
    EXPECT_EQ(ErrorOf(folder.path()), "");
  }
  EXPECT_EQ(TrainingSet(folder.path()).num_images(), 2U);
  EXPECT_FALSE(std::filesystem::exists(folder / "images.bin.part"));
  TrainingSetWriter writer(folder.path());
  const View view{writer.AddImage(TestImage(100, 100, 0), {}), 50.0F, 50.0F, 2.0F};
  writer.AddPoint({&view, 1});
  writer.Finish("");
  EXPECT_EQ(TrainingSet(folder.path()).num_images(), 1U);
}

TEST(TrainingSetWriter, LeavesAColmapModelAlone) {
  const TemporaryFolder folder;
  folder.Write("images.bin", "COLMAP's");
  folder.Write("points3D.bin", "");
  EXPECT_THROW(TrainingSetWriter(folder.path()), InputError);
  EXPECT_EQ(ReadText(folder / "images.bin"), "COLMAP's");
}

TEST(TrainingSetWriter, RefusesASetWithoutPoints) {
  const TemporaryFolder folder;
  TrainingSetWriter writer(folder.path());
  writer.AddImage(TestImage(100, 100, 0), {});
  EXPECT_THROW(writer.Finish(""), InputError);
}

TEST(PatchView, CutsWhatTheExtractorCuts) {
  const GrayImage image = TestImage(320, 240, 0);
  PatchCutter cutter;
  cutter.SetImage(image);
  nn::WorkerTeam team(1);
  for (const double sigma : {1.3, 4.0, 9.0}) {
    const float angle = 0.7F;
    const LiftKeypoint keypoint{.x = 151.3, .y = 118.6, .sigma = sigma};
    const auto expected = cutter.Cut({&keypoint, 1}, {&angle, 1}, team);
    const double c = sigma * std::cos(0.7), s = sigma * std::sin(0.7);
    const PatchView view{.x = 151.3, .y = 118.6, .xu = c, .xv = -s, .yu = s, .yv = c};
    std::vector<std::uint8_t> patch(kLiftPatchSize * kLiftPatchSize);
    SamplePatchView(BuildPyramid(image, kTrainingPyramid), view, 6.0, kLiftPatchSize, patch);
    int largest = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      largest = std::max(largest, std::abs(patch[i] - expected[i]));
    }
    EXPECT_LE(largest, 1) << "sigma " << sigma;
  }
}

TEST(PatchView, ShiftedIsTheSamePlaneElsewhere) {
  Random random(3);
  const PatchView view = RandomPatchView({0, 100, 80, 3}, 0.4, true, {}, random);
  const PatchView shifted = Shifted(view, 1.5, -0.7);
  const auto at = [](const PatchView& v, double p, double q) {
    const double w = 1.0 + v.wu * p + v.wv * q;
    return std::pair(v.x + (v.xu * p + v.xv * q) / w, v.y + (v.yu * p + v.yv * q) / w);
  };
  const auto expected = at(view, 1.5 + 2.0, -0.7 + 3.0), got = at(shifted, 2.0, 3.0);
  EXPECT_NEAR(got.first, expected.first, 1e-9);
  EXPECT_NEAR(got.second, expected.second, 1e-9);
}

TEST(OpenTrainingSets, TakesPathsWithBlanks) {
  const TemporaryFolder folder;
  WriteSet(folder / "my set");
  WriteSet(folder / "b");
  const std::string path = (folder / "my set").string();
  EXPECT_EQ(OpenTrainingSets(std::vector{path}).size(), 1U);
  const auto sets = OpenTrainingSets(JoinWords({path + "=0.5", (folder / "b").string()}));
  ASSERT_EQ(sets.size(), 2U);
  EXPECT_EQ(sets[0].set->name(), "my set");
  EXPECT_EQ(sets[0].share, 0.5);
}

TEST(WordList, SplitsWhatItJoined) {
  const std::vector<std::string> words{"a", "b c", "d\\ e\\", " f"};
  EXPECT_EQ(SplitWords(JoinWords(words)), words);
  EXPECT_EQ(SplitWords("  a\tb \n"), std::vector<std::string>({"a", "b"}));
  EXPECT_TRUE(SplitWords(" ").empty());
}

TEST(PatchSampler, DrawsTheSameBatchForTheSameNumber) {
  const TemporaryFolder folder;
  WriteSet(folder.path());
  const PatchRequest request{.count = 4, .max_shift = 1.0, .with_empty = true};
  const PatchSampler sampler(OpenTrainingSets(folder.path().string() + "=0.5"), request, {}, {}, 7);
  const PatchBatch a = sampler.Draw(5), b = sampler.Draw(5), c = sampler.Draw(6);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.empty, b.empty);
  EXPECT_NE(a.first, c.first);
  for (const float position : a.first_position) EXPECT_LE(std::abs(position), 1.0F / 6.0F + 1e-6F);
}

TEST(PatchSampler, ViewsOfOneSceneAreNoNegatives) {
  const TemporaryFolder folder;
  WriteSet(folder.path());
  const PatchSampler sampler(OpenTrainingSets(folder.path().string()), {.count = 16}, {}, {}, 7);
  const PatchBatch batch = sampler.Draw(0);
  // Two points in two images of one scene: nothing is surely different.
  EXPECT_EQ(std::count(batch.different.begin(), batch.different.end(), 1), 0);
}

TEST(PatchSampler, RefusesSetsThatCannotServe) {
  const TemporaryFolder folder;
  WriteSet(folder.path());
  const auto sets = OpenTrainingSets(folder.path().string());
  EXPECT_THROW(PatchSampler(sets, {.min_sigma = 50.0}, {}, {}, 1), InputError);
  EXPECT_THROW(OpenTrainingSets(""), InputError);
  EXPECT_THROW(OpenTrainingSets(folder.path().string() + "=-1"), InputError);
}

TEST(TrainingLog, BeginsAnewWithOtherFigures) {
  const TemporaryFolder folder;
  TrainingLog(folder.path(), false, 0).Add({.step = 2, .loss = 0.5});
  TrainingLog log(folder.path(), true, 2);
  log.Add({.step = 4, .loss = 0.25, .validation = {{"FPR95", 0.1}}});
  log.Add({.step = 6, .loss = 0.25, .validation = {{"FPR95", 0.2}}});
  EXPECT_EQ(ReadText(folder / "log.csv"),
            "step,hours,loss,steps_per_s,FPR95\n4,0.0000,0.25000,0.00,0.10000\n"
            "6,0.0000,0.25000,0.00,0.20000\n");
  EXPECT_EQ(ReadText(folder / "log.1.csv"), "step,hours,loss,steps_per_s\n2,0.0000,0.50000,0.00\n");
}

TEST(ChangeLight, StaysWithinGreyValuesAndKeepsThePatchWithoutChanges) {
  std::vector<std::uint8_t> patch(64 * 64, 200);
  Random random(1);
  const PhotometryOptions none{.max_gamma = 1.0,
                               .gamma_share = 0.0,
                               .max_gain = 1.0,
                               .max_offset = 0.0,
                               .max_noise = 0.0,
                               .blurred_share = 0.0};
  ChangeLight(patch, 64, none, random);
  EXPECT_THAT(patch, testing::Each(200));
  ChangeLight(patch, 64, {.max_noise = 50.0}, random);
  EXPECT_THAT(patch, testing::Not(testing::Each(200)));
}

}  // namespace
}  // namespace lift_slam::training
