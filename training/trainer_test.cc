#include "training/trainer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <opencv2/imgcodecs.hpp>

#include "lift_slam/features/lift/lift_extractor.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "training/fine_tune_command.h"
#include "training/fine_tuning.h"
#include "training/first_weights.h"
#include "training/photograph_import.h"
#include "training/weights_calibration.h"

namespace lift_slam::training {
namespace {

// Blobs of all sizes: keypoints at many scales.
cv::Mat Blobs(int seed) {
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(120));
  Random random(static_cast<std::uint64_t>(seed));
  for (int i = 0; i < 250; ++i) {
    const int x = random.UniformInt(0, 319), y = random.UniformInt(0, 239);
    const int radius = random.UniformInt(2, 12), grey = random.UniformInt(0, 255);
    for (int v = std::max(0, y - radius); v < std::min(240, y + radius); ++v) {
      for (int u = std::max(0, x - radius); u < std::min(320, x + radius); ++u) {
        if (std::hypot(u - x, v - y) < radius)
          image.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(grey);
      }
    }
  }
  return image;
}

void MakeSet(const TemporaryFolder& folder) {
  std::filesystem::create_directories(folder / "pictures");
  for (int i = 0; i < 3; ++i) {
    cv::imwrite(folder / ("pictures/" + std::to_string(i) + ".png"), Blobs(i));
  }
  TrainingSetWriter writer(folder / "set");
  ImportPhotographs(
      folder / "pictures", {.max_points = 60, .num_warps = 1, .max_empty_places = 10},
      [](int, int, std::size_t) {}, writer);
  writer.Finish("test");
}

TrainingOptions TinyRun(const TemporaryFolder& folder, const std::string& stage, int steps) {
  TrainingOptions options;
  options.stage = stage;
  options.data = options.validation = (folder / "set").string();
  options.run.threads =
      1;  // steps so small gain nothing by more, and wait for them when others work
  options.run.validation_every = 2;
  options.run.validation_batches = 1;
  for (ScheduleOptions* schedule :
       {&options.descriptor.schedule, &options.orientation.schedule, &options.detector.schedule}) {
    *schedule = {.batch = 6, .steps = steps, .learning_rate = 1e-3};
  }
  return options;
}

RunState TrainOn(const TrainingOptions& options, const std::filesystem::path& output, bool resume,
                 int steps = 1000) {
  Trainer trainer(options, output, resume, "test");
  trainer.Run([&](const TrainingProgress&) { return --steps > 0; });
  return trainer.state();
}

std::vector<float> Values(LiftWeights& weights, const std::string& network) {
  std::vector<float> values;
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (!parameter.name.starts_with(network)) continue;
    values.insert(values.end(), parameter.values.begin(), parameter.values.end());
  }
  return values;
}

std::vector<float> ValuesIn(const std::filesystem::path& file, const std::string& network) {
  LiftWeights weights = ReadLiftWeights(file);
  return Values(weights, network);
}

float LargestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  float largest = a.size() == b.size() ? 0.0F : 1e9F;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

TEST(Trainer, TrainsAllThreeNetworksAndTheirWeightsExtractFeatures) {
  const TemporaryFolder folder;
  MakeSet(folder);
  std::string from;
  for (const char* stage : {"descriptor", "orientation", "detector"}) {
    TrainingOptions options = TinyRun(folder, stage, 4);
    options.from = from;
    EXPECT_EQ(TrainOn(options, folder / stage, false).step, 4);
    from = (folder / (std::string(stage) + "/best.safetensors")).string();
    EXPECT_TRUE(std::filesystem::exists(folder / (std::string(stage) + "/curves.html")));
  }
  const LiftWeights weights = ReadLiftWeights(from);
  EXPECT_THAT(weights.provenance, testing::HasSubstr("unknown: 3 images"));
  LiftExtractor extractor(weights, {.max_features = 50});
  EXPECT_GT(extractor.Extract(GrayImage(Blobs(9))).keypoints.size(), 5U);
}

TEST(Trainer, TheOtherLossesTrainToo) {
  const TemporaryFolder folder;
  MakeSet(folder);
  TrainingOptions pairs = TinyRun(folder, "descriptor", 2);
  pairs.descriptor.loss = DescriptorLoss::kPairs;
  EXPECT_EQ(TrainOn(pairs, folder / "pairs", false).skipped, 0);
  TrainingOptions triplets = TinyRun(folder, "descriptor", 2);
  triplets.descriptor.loss = DescriptorLoss::kTriplet;
  EXPECT_EQ(TrainOn(triplets, folder / "triplets", false).skipped, 0);
  TrainingOptions equation2 = TinyRun(folder, "orientation", 2);
  equation2.orientation.loss = OrientationLoss::kDescriptor;
  EXPECT_EQ(TrainOn(equation2, folder / "equation2", false).skipped, 0);
  TrainingOptions equation5 = TinyRun(folder, "detector", 2);
  equation5.detector.pair_steps = 1;
  EXPECT_EQ(TrainOn(equation5, folder / "equation5", false).skipped, 0);
}

TEST(Trainer, GoesOnFromItsCheckpointAsIfNeverStopped) {
  const TemporaryFolder folder;
  MakeSet(folder);
  TrainingOptions options = TinyRun(folder, "detector", 4);
  options.detector.schedule.learning_rate = 1e-2;
  options.detector.schedule.warm_up_steps = 0;
  TrainOn(options, folder / "whole", false);
  EXPECT_EQ(TrainOn(options, folder / "parts", false, 2).step, 2);
  EXPECT_EQ(TrainOn(options, folder / "parts", true).step, 4);
  LiftWeights start = RandomLiftWeights(LiftTopology::kF, 1);
  BeginWithBlobs(start);
  const std::vector<float> began = Values(start, "detector.");
  const std::vector<float> whole = ValuesIn(folder / "whole/latest.safetensors", "detector.");
  const std::vector<float> parts = ValuesIn(folder / "parts/latest.safetensors", "detector.");
  EXPECT_GT(LargestDifference(whole, began), 1e-3F);
  EXPECT_LT(LargestDifference(whole, parts), 1e-5F);
}

TEST(Trainer, ChoosesTheBestByAValidationThatWasAddedLater) {
  const TemporaryFolder folder;
  MakeSet(folder);
  TrainingOptions options = TinyRun(folder, "detector", 4);
  options.validation.clear();
  EXPECT_LT(TrainOn(options, folder / "run", false, 2).best, 0.0);
  options.validation = options.data;
  EXPECT_GE(TrainOn(options, folder / "run", true).best, 0.0);
  EXPECT_THAT(ReadText(folder / "run/log.1.csv"),
              testing::StartsWith("step,hours,loss,steps_per_s\n2,"));
  EXPECT_THAT(ReadText(folder / "run/log.csv"), testing::HasSubstr("\n4,"));
}

TEST(TrainInTurn, TakesOfEachRunOnlyItsOwnNetwork) {
  const TemporaryFolder folder;
  MakeSet(folder);
  LiftWeights from = RandomLiftWeights(LiftTopology::kF, 3);
  WriteLiftWeights(from, folder / "from.safetensors");
  TrainingOptions options = TinyRun(folder, "", 1);
  options.validation.clear();
  options.from = (folder / "from.safetensors").string();
  options.descriptor.schedule.warm_up_steps = 0;
  options.orientation.loss = OrientationLoss::kDescriptor;
  TrainInTurn({"orientation"}, options, folder / "tuned", 0.0);
  testing::internal::CaptureStderr();
  TunedWeights tuned = TrainInTurn({"descriptor", "orientation"}, options, folder / "tuned", 0.0);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("another descriptor"));
  EXPECT_TRUE(tuned.is_complete);
  ASSERT_TRUE(tuned.weights);
  for (const std::string stage : {"descriptor", "orientation"}) {
    const std::vector<float> values = Values(*tuned.weights, stage + ".");
    EXPECT_EQ(values, ValuesIn(folder / ("tuned/" + stage + "/best.safetensors"), stage + "."));
    EXPECT_NE(values, Values(from, stage + ".")) << stage;
    EXPECT_THAT(tuned.weights->provenance, testing::HasSubstr(stage + ": 1 steps"));
  }
}

TEST(Trainer, LearnsToTellPointsApart) {
  const TemporaryFolder folder;
  MakeSet(folder);
  TrainingOptions options = TinyRun(folder, "descriptor", 20);
  options.descriptor.schedule.batch = 16;
  options.run.validation_every = 10;
  options.views = {.max_tilt = 1.1, .position_noise_sigmas = 0.05, .rotation_noise_deg = 1.0};
  Trainer trainer(options, folder / "run", false, "test");
  double first = 0.0, last = 0.0;
  trainer.Run([&](const TrainingProgress& progress) {
    if (first == 0.0) first = progress.loss;
    last = progress.loss;  // running mean
    return true;
  });
  EXPECT_LT(last, first - 0.02);
}

void ScaleLastLayer(LiftWeights& weights, float factor) {
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (!parameter.name.starts_with("descriptor.conv3.")) continue;
    for (float& value : parameter.values) value *= factor;
  }
}

TEST(CarryOverCalibration, BringsDistancesBackToWhatTheyWere) {
  const TemporaryFolder folder;
  MakeSet(folder);
  TrainOn(TinyRun(folder, "descriptor", 1), folder / "run", false);
  LiftWeights from = ReadLiftWeights(folder / "run/latest.safetensors");
  from.distances = DistanceQuantiles{{1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}};
  LiftWeights weights = from;
  weights.distances.reset();
  ScaleLastLayer(weights, 3.0F);
  CarryOverCalibration(from, OpenTrainingSets((folder / "set").string()), {1, 8}, weights);
  ASSERT_TRUE(weights.distances);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(weights.distances->matching[i], from.distances->matching[i], 1e-3);
    EXPECT_NEAR(weights.distances->nearest_wrong[i], from.distances->nearest_wrong[i], 1e-3);
  }
  EXPECT_EQ(weights.descriptor_ranges.size(), 3U);
  auto expected = Parameters(from), got = Parameters(weights);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(expected[i].values[0], got[i].values[0], 1e-4) << expected[i].name;
  }
}

void FineTune(const TemporaryFolder& folder, const std::string& more) {
  CLI::App app;
  AddFineTuneCommand(app);
  const std::string set = (folder / "set").string();
  app.parse("fine-tune --from " + (folder / "from.safetensors").string() + " --data " + set +
            " --validation " + set + " --output " + (folder / "tuned").string() + " " + more);
}

TEST(FineTune, AlsoLeavesWeightsWhenItEndsEarly) {
  const TemporaryFolder folder;
  MakeSet(folder);
  TrainOn(TinyRun(folder, "descriptor", 1), folder / "run", false);
  LiftWeights from = ReadLiftWeights(folder / "run/latest.safetensors");
  from.distances = DistanceQuantiles{{1, 2, 3, 4, 5}, {6, 7, 8, 9, 10}};
  from.descriptor_ranges = {1, 2, 3};
  WriteLiftWeights(from, folder / "from.safetensors");
  FineTune(folder,
           "--minutes 0.0001 --set run.threads=1 --set run.validation_batches=1 "
           "--set orientation.schedule.batch=6");
  const LiftWeights tuned = ReadLiftWeights(folder / "tuned/weights.safetensors");
  EXPECT_EQ(tuned.name, "fine-tuned (orientation, not to the end)");
  EXPECT_EQ(tuned.distances, from.distances);
  EXPECT_EQ(tuned.descriptor_ranges, from.descriptor_ranges);
  // Good weights are shown the hardest wrong points from the first step on.
  EXPECT_THAT(ReadText(folder / "tuned/orientation/settings.yaml"),
              testing::HasSubstr("easy_steps: 0\n"));
  // The margin goes by the scale of their distances: 8 / 2.3.
  EXPECT_THAT(ReadText(folder / "tuned/orientation/settings.yaml"),
              testing::HasSubstr("margin: 3.478"));
}

TEST(Trainer, KeepsTheWeightsItBeganWithWhenTrainingMakesThemWorse) {
  const TemporaryFolder folder;
  MakeSet(folder);
  TrainOn(TinyRun(folder, "detector", 1), folder / "first", false);
  TrainingOptions options = TinyRun(folder, "detector", 4);
  options.from = (folder / "first/latest.safetensors").string();
  options.detector.schedule.learning_rate = 1.0;
  options.detector.schedule.warm_up_steps = 0;
  TrainOn(options, folder / "run", false);
  LiftWeights from = ReadLiftWeights(options.from);
  LiftWeights best = ReadLiftWeights(folder / "run/best.safetensors");
  EXPECT_EQ(best.name, "detector after 0 steps");
  const auto expected = Parameters(from), got = Parameters(best);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(expected[i].values, got[i].values)) << expected[i].name;
  }
  EXPECT_THAT(ReadText(folder / "run/log.csv"), testing::HasSubstr("\n0,0.0000,,,"));
}

TEST(Trainer, RefusesWhatCannotBe) {
  const TemporaryFolder folder;
  MakeSet(folder);
  const auto refuses = [&](const TrainingOptions& options, bool resume, const char* why) {
    try {
      Trainer trainer(options, folder / "run", resume, "test");
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(why));
      return;
    }
    ADD_FAILURE() << "not refused: " << why;
  };
  TrainingOptions options = TinyRun(folder, "detector", 2);
  refuses(options, true, "nothing to resume");
  TrainingOptions nowhere = options;
  nowhere.data = (folder / "nowhere").string();
  refuses(nowhere, false, "no such training set");
  TrainingOptions unknown = options;
  unknown.stage = "colour";
  refuses(unknown, false, "is unknown");
  TrainOn(options, folder / "run", false);
  refuses(options, false, "--resume");
}

}  // namespace
}  // namespace lift_slam::training
