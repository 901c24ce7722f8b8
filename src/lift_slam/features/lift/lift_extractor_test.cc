#include "lift_slam/features/lift/lift_extractor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "lift_slam/features/lift/default_weights.h"
#include "lift_slam/features/lift/lift_reference_for_test.h"
#include "lift_slam/features/lift/lift_weights_import.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using testing::HasSubstr;

GrayImage Texture(int width, int height) {
  Random random(11);
  cv::Mat image(height, width, CV_8UC1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at<uchar>(y, x) = static_cast<uchar>(random.Bits());
  }
  cv::GaussianBlur(image, image, {}, 1.5);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return GrayImage(image);
}

bool SameBytes(const FeatureSet& a, const FeatureSet& b) {
  const auto same = [](const auto* p, const auto* q, std::size_t bytes) {
    return bytes == 0 || std::memcmp(p, q, bytes) == 0;
  };
  return a.keypoints.size() == b.keypoints.size() &&
         same(a.keypoints.data(), b.keypoints.data(), a.keypoints.size() * sizeof(Keypoint)) &&
         same(a.descriptors.data(), b.descriptors.data(),
              a.descriptors.size() * a.descriptors.kind().BytesPerRow());
}

TEST(LiftExtractor, NumberOfThreadsAndFramesBeforeChangeNothing) {
  const LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3);
  LiftExtractor alone(weights, {.max_features = 40, .upright = false});
  LiftExtractor together(weights, {.max_features = 40, .upright = false, .num_threads = 3});
  const GrayImage image = Texture(230, 170);
  const FeatureSet features = alone.Extract(image);
  EXPECT_EQ(features.keypoints.size(), 40U);
  EXPECT_TRUE(SameBytes(features, together.Extract(image)));
  together.Extract(Texture(150, 180));
  EXPECT_TRUE(SameBytes(features, together.Extract(image)));
}

TEST(LiftExtractor, KeypointsAreWithinTheImageWithScalesOfTheirLevels) {
  LiftExtractor extractor(RandomLiftWeights(LiftTopology::kF, 3),
                          {.max_features = 0, .upright = false});
  const FeatureSet features = extractor.Extract(Texture(230, 170));
  ASSERT_GT(features.keypoints.size(), 50U);
  ASSERT_EQ(features.descriptors.size(), features.keypoints.size());
  bool turned = false;
  for (const Keypoint& k : features.keypoints) {
    // 6 sigma, of a sigma up to half a level smaller.
    const double margin = 6 * extractor.scale_levels().Scale(k.level) * std::exp2(-0.1) - 1e-3;
    const bool clamped = k.level == 0;
    if (!clamped) {
      EXPECT_GE(std::min({k.x, k.y, 229 - k.x, 169 - k.y}), margin);
    }
    turned = turned || std::abs(k.angle_rad) > 0.1F;
  }
  EXPECT_TRUE(turned);
  EXPECT_NEAR(extractor.scale_levels().Scale(5), 2.0, 1e-9);
}

TEST(LiftExtractor, UprightDescriptorsAreThoseOfTheirPatches) {
  const LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
  LiftExtractor extractor(
      weights, {.max_features = 5, .precision = nn::Precision::kFloat32, .upright = true});
  const GrayImage image = Texture(230, 170);
  const FeatureSet features = extractor.Extract(image);
  KeypointDetector detector({});
  LiftNetworks networks(weights, {});
  PatchCutter cutter;
  cutter.SetImage(image);
  std::size_t num_checked = 0;
  for (const LiftKeypoint& k : detector.Detect(image, networks)) {
    for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
      if (features.keypoints[i].x != static_cast<float>(k.x) ||
          features.keypoints[i].y != static_cast<float>(k.y)) {
        continue;
      }
      const auto values =
          networks.DescribePatches(cutter.Cut(std::span(&k, 1), {}, networks.team()));
      EXPECT_EQ(features.keypoints[i].angle_rad, 0.0F);
      EXPECT_LT(DescriptorDistance(extractor.descriptor_kind(), features.descriptors.row(i),
                                   std::as_bytes(values)),
                1e-4F);
      ++num_checked;
    }
  }
  EXPECT_EQ(num_checked, 5U);
}

TEST(LiftExtractor, WithoutOrientationNetworkOnlyUpright) {
  const LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 3, /*with_orientation=*/false);
  try {
    LiftExtractor extractor(weights, {.upright = false});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("lift.upright"));
  }
}

TEST(LiftExtractor, ImageSmallerThanAPatchIsRefused) {
  LiftExtractor extractor(RandomLiftWeights(LiftTopology::kF, 3), {});
  for (const auto& [width, height] : {std::pair{63, 200}, {200, 63}}) {
    EXPECT_THROW(extractor.Extract(Texture(width, height)), InputError);
  }
  EXPECT_THROW(extractor.Extract({}), InputError);
  EXPECT_NO_THROW(extractor.Extract(Texture(64, 64)));
}

TEST(LiftExtractor, FlatImageHasNoFeatures) {
  LiftExtractor extractor(ReadLiftWeightsOrDefault(""), {.max_features = 0});
  for (const int gray : {0, 128, 255}) {
    const FeatureSet features =
        extractor.Extract(GrayImage(cv::Mat(120, 160, CV_8UC1, cv::Scalar(gray))));
    EXPECT_EQ(features.keypoints.size(), 0U) << "of gray " << gray;
    EXPECT_EQ(features.descriptors.size(), 0U);
  }
}

TEST(LiftDescriptorKind, TellsWeightsAndOrientationApart) {
  const LiftWeights a = RandomLiftWeights(LiftTopology::kF, 1);
  const LiftWeights b = RandomLiftWeights(LiftTopology::kF, 2);
  EXPECT_EQ(LiftDescriptorKind(a, false), LiftDescriptorKind(a, false));
  EXPECT_NE(LiftDescriptorKind(a, false), LiftDescriptorKind(b, false));
  EXPECT_NE(LiftDescriptorKind(a, false), LiftDescriptorKind(a, true));
  LiftWeights saved = a;
  saved.sha256 = "c0ffee";
  EXPECT_EQ(LiftDescriptorKind(saved, false).name, "lift:c0ffee");
}

void ExpectThresholds(const MatchingThresholds& actual, float low, float high) {
  EXPECT_FLOAT_EQ(actual.low, low);
  EXPECT_FLOAT_EQ(actual.high, high);
}

TEST(LiftThresholds, ComeFromOptionsThenWeightsThenThePaper) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 1);
  ExpectThresholds(LiftThresholds(weights, {}).fixed, 2.0F, 3.0F);
  ExpectThresholds(LiftThresholds(weights, {}).strict, 1.0F, 2.0F);
  ExpectThresholds(LiftThresholds(weights, {}).loose, 2.0F, 3.0F);
  weights.distances =
      DistanceQuantiles{{0.1F, 0.2F, 0.5F, 0.9F, 1.1F}, {1.0F, 1.5F, 2.0F, 2.4F, 3.0F}};
  // 1.3 times 2 and 3.
  ExpectThresholds(LiftThresholds(weights, {}).fixed, 1.1F, 2.6F);
  ExpectThresholds(LiftThresholds(weights, {}).strict, 1.1F, 2.6F);
  ExpectThresholds(LiftThresholds(weights, {}).loose, 2.6F, 3.9F);
  ExpectThresholds(LiftThresholds(weights, {.low_threshold = 1.0}).fixed, 1.0F, 2.6F);
}

// Weights whose matches lie farther apart than their impostors have no gap to put a threshold in.
TEST(LiftThresholds, StayInOrder) {
  LiftWeights weights = RandomLiftWeights(LiftTopology::kF, 1);
  weights.distances =
      DistanceQuantiles{{0.1F, 0.2F, 0.5F, 0.9F, 3.5F}, {1.0F, 1.5F, 2.1F, 2.4F, 3.0F}};
  const ThresholdRange range = LiftThresholds(weights, {});
  EXPECT_LE(range.strict.low, range.strict.high);
  EXPECT_LE(range.strict.low, range.loose.low);
  EXPECT_LE(range.strict.high, range.loose.high);
  EXPECT_LE(range.loose.low, range.loose.high);
}

// A frame of KITTI, or nothing.
GrayImage KittiFrame(const std::string& file) {
  const char* data = std::getenv("LIFT_SLAM_DATA");
  const char* source = std::getenv("LIFT_SLAM_SOURCE_DIR");
  std::filesystem::path folder;
  if (data != nullptr) {
    folder = data;
  } else if (source != nullptr) {
    folder = std::filesystem::path(source) / "../shared/data";
  }
  return ReadGrayImage(folder / "kitti/sequences" / file).value_or(GrayImage());
}

LiftWeights Released() {
  const std::filesystem::path files[] = {LiftReferenceFolder() / "tf-lift-release.h5"};
  return ImportLiftWeights(files, {});
}

std::vector<LiftKeypoint> Best(std::vector<LiftKeypoint> keypoints, std::size_t count) {
  std::sort(keypoints.begin(), keypoints.end(),
            [](const LiftKeypoint& a, const LiftKeypoint& b) { return a.score > b.score; });
  keypoints.resize(std::min(count, keypoints.size()));
  return keypoints;
}

// The part of a's keypoints with one of b's within 3 pixels of where `b_from_a` (2 x 3) carries
// them, of those that come to lie within the image.
double Repeatability(const std::vector<LiftKeypoint>& a, const std::vector<LiftKeypoint>& b,
                     const cv::Matx23d& b_from_a, const GrayImage& image) {
  int num_visible = 0, num_repeated = 0;
  for (const LiftKeypoint& k : a) {
    const cv::Vec2d there = b_from_a * cv::Vec3d(k.x, k.y, 1.0);
    const double margin = 15 * k.sigma;
    if (there[0] < margin || there[1] < margin || there[0] > image.width() - margin ||
        there[1] > image.height() - margin) {
      continue;
    }
    ++num_visible;
    num_repeated += std::any_of(b.begin(), b.end(), [&](const LiftKeypoint& other) {
      return std::hypot(other.x - there[0], other.y - there[1]) < 3.0;
    });
  }
  return num_visible == 0 ? 0.0 : static_cast<double>(num_repeated) / num_visible;
}

class LiftOnKitti : public testing::Test {
 protected:
  void SetUp() override {
    LIFT_SLAM_SKIP_WITHOUT_REFERENCE();
    image_ = KittiFrame("06/image_0/000000.png");
    if (image_.empty()) GTEST_SKIP() << "no KITTI 06 (LIFT_SLAM_DATA)";
  }
  GrayImage image_;
};

// About 1550 by an independent implementation of the authors' settings.
TEST_F(LiftOnKitti, NumberOfKeypoints) {
  LiftNetworks networks(Released(), {.num_threads = 2});
  KeypointDetector original({.nms_levels = 2, .coordinates = LevelCoordinates::kOriginal});
  const std::size_t num_original = original.Detect(image_, networks).size();
  EXPECT_GT(num_original, 1200U);
  EXPECT_LT(num_original, 1900U);
  const std::size_t num_default = KeypointDetector({}).Detect(image_, networks).size();
  EXPECT_GE(num_default, 2000U);
  std::printf("keypoints: %zu as the authors, %zu by default\n", num_original, num_default);
}

TEST_F(LiftOnKitti, KeypointsRepeatInATurnedAndScaledImage) {
  LiftNetworks networks(Released(), {.num_threads = 2});
  const cv::Matx23d warp(cv::getRotationMatrix2D({620.0F, 188.0F}, 8.0, 1.25));
  cv::Mat warped;
  cv::warpAffine(image_.mat(), warped, warp, image_.mat().size(), cv::INTER_LINEAR,
                 cv::BORDER_REFLECT);
  for (const auto how : {LevelCoordinates::kExact, LevelCoordinates::kOriginal}) {
    KeypointDetector detector({.coordinates = how});
    const auto a = Best(detector.Detect(image_, networks), 500);
    const auto b = Best(detector.Detect(GrayImage(warped), networks), 500);
    const double repeatability = Repeatability(a, b, warp, image_);
    std::printf("repeatability of 500 (3 px): %.3f\n", repeatability);
    EXPECT_GT(repeatability, 0.45);
  }
}

}  // namespace
}  // namespace lift_slam
