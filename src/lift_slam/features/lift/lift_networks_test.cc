// Against expected values that were computed independently, in double precision, from the weights
// that the authors of LIFT released; and, without them, the two back-ends against each other.
#include "lift_slam/features/lift/lift_networks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/features/lift/lift_weights_import.h"
#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/features/lift/patch_sampling.h"
#include "lift_slam/nn/reference_layers.h"
#include "lift_slam/nn/soft_argmax.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using Json = nlohmann::json;
using nn::Backend;

constexpr double kTolerance = 1e-4;

LiftWeights Imported(const LiftImport& wanted) {
  const std::filesystem::path files[] = {LiftReferenceFolder() / "new-CNN3-picc-iter-56k.h5",
                                         LiftReferenceFolder() / "tf-lift-release.h5"};
  return ImportLiftWeights(files, wanted);
}

double LargestDifference(std::span<const float> a, std::span<const float> b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = a.size() == b.size() ? 0.0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double difference = std::abs(static_cast<double>(a[i]) - b[i]);
    largest = std::isfinite(difference) ? std::max(largest, difference) : 1e9;
  }
  return largest;
}

GrayImage ReadRawImage(const std::string& file, int width, int height) {
  std::vector<std::uint8_t> bytes = ReadRaw<std::uint8_t>(LiftReferenceFolder() / file);
  return GrayImage(cv::Mat(height, width, CV_8UC1, bytes.data()).clone());
}

Json ReadJson(const std::string& file) {
  return Json::parse(ReadText(LiftReferenceFolder() / file));
}

class LiftReference : public testing::TestWithParam<Backend> {
 protected:
  void SetUp() override { LIFT_SLAM_SKIP_WITHOUT_REFERENCE(); }
};

TEST_P(LiftReference, DescriptorsOfPatchesAndEdgeCases) {
  for (const LiftTopology topology : {LiftTopology::kF, LiftTopology::kT}) {
    LiftNetworks networks(Imported({.topology = topology}), {.backend = GetParam()});
    for (const std::string set : {"patches16", "edge_cases"}) {
      const auto patches = ReadRaw<std::uint8_t>(LiftReferenceFolder() / (set + "_u8.raw"));
      const auto expected = ReadRaw<float>(
          LiftReferenceFolder() /
          (set + (topology == LiftTopology::kF ? "_desc_tflift_f32.raw" : "_desc_theano_f32.raw")));
      const auto found = networks.DescribePatches(std::span<const std::uint8_t>(patches));
      const double difference = LargestDifference(found, expected);
      EXPECT_LT(difference, kTolerance) << Name(topology) << " " << set;
      RecordProperty(set + std::string(Name(topology)), std::to_string(difference));
    }
  }
}

TEST_P(LiftReference, DetectorScoreMaps) {
  const GrayImage image = ReadRawImage("det_image_u8.raw", 128, 96);
  for (const auto detector : {ReleasedDetector::kAugmented, ReleasedDetector::kNotAugmented}) {
    const bool augmented = detector == ReleasedDetector::kAugmented;
    const auto expected = ReadRaw<float>(
        LiftReferenceFolder() / (augmented ? "det_score_aug_f32.raw" : "det_score_noaug_f32.raw"));
    for (const auto method : {DetectorMethod::kDirect, DetectorMethod::kFourier}) {
      LiftNetworks networks(Imported({.detector = detector}),
                            {.backend = GetParam(), .detector = method});
      const ScoreMap map = networks.DetectorScores(image);
      EXPECT_EQ(map.width, 104);
      EXPECT_EQ(map.height, 72);
      EXPECT_LT(LargestDifference(map.scores, expected), kTolerance);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Backends, LiftReference,
                         testing::Values(Backend::kReference, Backend::kOneDnn),
                         [](const auto& test) {
                           return std::string(
                               nn::kBackendNames[static_cast<std::size_t>(test.param)]);
                         });

// The training's way: a patch of 128 x 128 is resampled to 48 x 48 (corners aligned), scored, and
// the middle 14 x 14 scores are taken.
nn::SoftMaximum TrainingDetection(const LiftWeights& weights, const GrayImage& patch) {
  constexpr int kSmall = 48, kCrop = 5, kMap = 24, kCropped = 14;
  nn::Tensor input({1, 1, kSmall, kSmall});
  SamplePatch(patch, {.x = 63.5, .y = 63.5, .half_width_px = 63.5}, kSmall, input.values());
  for (float& v : input.values()) {
    v = (v - weights.detector_input.mean) / weights.detector_input.scale;
  }
  const nn::Tensor scores = nn::ApplyNetwork(weights.detector, input);
  EXPECT_EQ(scores.shape(), (nn::Shape{1, 1, kMap, kMap}));
  std::vector<float> middle;
  for (int y = 0; y < kCropped; ++y) {
    for (int x = 0; x < kCropped; ++x) middle.push_back(scores.at(0, 0, y + kCrop, x + kCrop));
  }
  nn::SoftMaximum found = nn::SoftArgmax(middle, kCropped, 10.0);
  found.x = (found.x + 17) / 23.5 - 1;
  found.y = (found.y + 17) / 23.5 - 1;
  return found;
}

TEST(LiftReferenceData, SoftArgmaxOfDetectorPatches) {
  LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
  const Json results = ReadJson("detector.json")["softargmax"]["results"];
  const GrayImage patches = ReadRawImage("det_patches128_u8.raw", 128, 4 * 128);
  for (const auto detector : {ReleasedDetector::kAugmented, ReleasedDetector::kNotAugmented}) {
    const LiftWeights weights = Imported({.detector = detector});
    const Json& expected = results[detector == ReleasedDetector::kAugmented ? "aug" : "noaug"];
    for (int i = 0; i < 4; ++i) {
      const GrayImage patch(patches.mat().rowRange(128 * i, 128 * (i + 1)));
      const nn::SoftMaximum found = TrainingDetection(weights, patch);
      const Json& wanted = expected[static_cast<std::size_t>(i)];
      EXPECT_NEAR(found.x, wanted["x"].get<double>(), kTolerance) << i;
      EXPECT_NEAR(found.y, wanted["y"].get<double>(), kTolerance) << i;
      EXPECT_NEAR(found.score, wanted["score"].get<double>(), kTolerance) << i;
    }
  }
}

TEST(LiftReferenceData, PatchesAreCutTheSameWay) {
  LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
  const GrayImage image = ReadRawImage("crop_image_u8.raw", 280, 200);
  const auto expected = ReadRaw<float>(LiftReferenceFolder() / "crop_patches_f32.raw");
  const Json crop = ReadJson("crop.json");
  constexpr std::size_t kSize = kLiftPatchSize * kLiftPatchSize;
  std::size_t i = 0;
  for (const Json& row : crop["keypoints"]["rows"]) {
    const PatchFrame frame{.x = row[0],
                           .y = row[1],
                           .half_width_px = kLiftHalfWidthSigmas * row[2].get<double>(),
                           .angle_rad = row[3]};
    std::vector<float> patch(kSize);
    SamplePatch(image, frame, kLiftPatchSize, std::span<float>(patch));
    EXPECT_LT(LargestDifference(patch, std::span(expected).subspan(kSize * i++, kSize)), 1e-3) << i;
  }
  EXPECT_EQ(i, 6U);
}

std::vector<std::uint8_t> RandomPatches(std::size_t count) {
  Random random(9);
  std::vector<std::uint8_t> patches(count * kLiftPatchSize * kLiftPatchSize);
  for (std::uint8_t& v : patches) v = static_cast<std::uint8_t>(random.UniformInt(0, 255));
  return patches;
}

TEST(LiftNetworksTest, BackendsAgreeOnRandomWeights) {
  const std::vector<std::uint8_t> patches = RandomPatches(3);
  for (const LiftTopology topology : {LiftTopology::kF, LiftTopology::kT}) {
    const LiftWeights weights = RandomLiftWeights(topology, 4);
    LiftNetworks reference(weights,
                           {.backend = Backend::kReference, .detector = DetectorMethod::kDirect});
    LiftNetworks fast(weights, {.num_threads = 2});
    EXPECT_LT(LargestDifference(reference.DescribePatches(std::span(patches)),
                                fast.DescribePatches(std::span(patches))),
              kTolerance);
    EXPECT_LT(LargestDifference(reference.OrientPatches(patches), fast.OrientPatches(patches)),
              kTolerance);
    const GrayImage image(cv::Mat(70, 58, CV_8UC1, const_cast<std::uint8_t*>(patches.data())));
    const ScoreMap expected = reference.DetectorScores(image), found = fast.DetectorScores(image);
    EXPECT_EQ(found.width, 58 - 24);
    EXPECT_EQ(found.height, 70 - 24);
    EXPECT_LT(LargestDifference(expected.scores, found.scores), kTolerance);
  }
}

TEST(LiftNetworksTest, LowerPrecisionStaysNear) {
  const std::vector<std::uint8_t> patches = RandomPatches(20);
  for (const LiftTopology topology : {LiftTopology::kF, LiftTopology::kT}) {
    LiftWeights weights = RandomLiftWeights(topology, 4, /*with_orientation=*/false);
    weights.descriptor_ranges =
        MeasureDescriptorRanges(weights, std::span(patches).first(2 * 64 * 64));
    LiftNetworks exact(weights, {});
    const auto expected = exact.DescribePatches(std::span(patches));
    float largest = 0.0F;
    for (const float v : expected) largest = std::max(largest, std::abs(v));
    for (const auto precision : {nn::Precision::kBfloat16, nn::Precision::kInt8}) {
      LiftNetworks networks(weights, {.precision = precision});
      EXPECT_LT(LargestDifference(networks.DescribePatches(std::span(patches)), expected),
                0.06 * largest)
          << Name(topology) << " " << nn::Name(precision);
    }
  }
}

TEST(LiftNetworksTest, ImagesWithoutRoomForTheFilterHaveNoScores) {
  LiftNetworks networks(RandomLiftWeights(LiftTopology::kF, 4, /*with_orientation=*/false), {});
  for (const auto& [width, height, scores] : {std::tuple{24, 90, 0}, {25, 25, 1}, {0, 0, 0}}) {
    const ScoreMap map =
        networks.DetectorScores(GrayImage(cv::Mat(height, width, CV_8UC1, cv::Scalar(9))));
    EXPECT_EQ(map.scores.size(), static_cast<std::size_t>(scores));
    EXPECT_EQ(map.width * map.height, scores);
  }
  EXPECT_FALSE(networks.has_orientation());
  EXPECT_THROW(networks.OrientPatches(RandomPatches(1)), CheckError);
}

TEST(LiftAngleTest, IsTheDirectionOfTheTwoValues) {
  EXPECT_NEAR(LiftAngle(2.0F, 2.0F), M_PI / 4, 1e-6);
  EXPECT_NEAR(LiftAngle(-1.0F, 1.0F), 3 * M_PI / 4, 1e-6);
  EXPECT_NEAR(LiftAngle(0.0F, -5.0F), -M_PI / 2, 2e-3);
  EXPECT_NEAR(LiftAngle(0.0F, 0.0F), M_PI / 4, 1e-6);
}

TEST(PatchSampling, UprightPatchOfItsOwnSizeIsTheImage) {
  std::vector<std::uint8_t> bytes = RandomPatches(1);
  const GrayImage image(cv::Mat(64, 64, CV_8UC1, bytes.data()));
  std::vector<std::uint8_t> patch(bytes.size());
  SamplePatch(image, {.x = 31.5, .y = 31.5, .half_width_px = 31.5}, 64, std::span(patch));
  EXPECT_EQ(patch, bytes);
  EXPECT_TRUE(LiesWithin(image, 31.5, 31.5, 31.5));
  EXPECT_FALSE(LiesWithin(image, 31.6, 31.5, 31.5));
  EXPECT_FALSE(LiesWithin(image, 31.5, 31.4, 31.5));
}

TEST(PatchSampling, QuarterTurnRotatesThePatch) {
  std::vector<std::uint8_t> bytes = RandomPatches(1);
  const GrayImage image(cv::Mat(64, 64, CV_8UC1, bytes.data()));
  std::vector<std::uint8_t> patch(bytes.size());
  SamplePatch(image, {.x = 31.5, .y = 31.5, .half_width_px = 31.5, .angle_rad = M_PI / 2}, 64,
              std::span(patch));
  // The patch's +x axis points down in the image.
  EXPECT_EQ(patch[5], image.row(5)[63]);
  EXPECT_EQ(patch[64 * 7 + 5], image.row(5)[63 - 7]);
}

}  // namespace
}  // namespace lift_slam
