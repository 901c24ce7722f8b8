#include "lift_slam/features/orb/orb_extractor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "lift_slam/util/input_error.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

// Overlapping rectangles of random grey.
cv::Mat Rectangles(int width, int height, std::uint64_t seed) {
  Random random(seed);
  cv::Mat image(height, width, CV_8UC1, cv::Scalar(90));
  for (int i = 0; i < width * height / 300; ++i) {
    const cv::Rect rectangle(random.UniformInt(-10, width), random.UniformInt(-10, height),
                             random.UniformInt(4, 40), random.UniformInt(4, 40));
    cv::rectangle(image, rectangle, cv::Scalar(random.UniformInt(0, 255)), cv::FILLED);
  }
  cv::GaussianBlur(image, image, {3, 3}, 0.8);
  return image;
}

bool SameFeatures(const FeatureSet& a, const FeatureSet& b) {
  const auto same_keypoint = [](const Keypoint& p, const Keypoint& q) {
    return p.x == q.x && p.y == q.y && p.angle_rad == q.angle_rad && p.response == q.response &&
           p.level == q.level;
  };
  const std::size_t bytes = a.descriptors.size() * OrbDescriptor::kBytes;
  return std::equal(a.keypoints.begin(), a.keypoints.end(), b.keypoints.begin(), b.keypoints.end(),
                    same_keypoint) &&
         a.descriptors.size() == b.descriptors.size() &&
         std::equal(a.descriptors.data(), a.descriptors.data() + bytes, b.descriptors.data());
}

TEST(OrbExtractor, FeatureCountFollowsTheArea) {
  EXPECT_EQ(FeatureCount({}, 1241, 376), 2000);
  EXPECT_EQ(FeatureCount({}, 640, 480), 1317);
  EXPECT_EQ(FeatureCount({}, 64, 48), 1200);
  EXPECT_EQ(FeatureCount({}, 4000, 3000), 6000);
  EXPECT_EQ(FeatureCount({.max_features = 77}, 640, 480), 77);
}

TEST(OrbExtractor, FillsEveryLevelWithinTheImage) {
  const GrayImage image(Rectangles(640, 480, 1));
  const FeatureSet features = CreateOrbExtractor({})->Extract(image);
  EXPECT_EQ(features.keypoints.size(), 1317U);
  EXPECT_EQ(features.descriptors.size(), features.keypoints.size());
  EXPECT_EQ(features.descriptors.kind(), (DescriptorKind{"orb", DescriptorMetric::kHamming, 256}));
  std::array<int, 8> per_level{};
  for (const Keypoint& k : features.keypoints) {
    ++per_level[static_cast<std::size_t>(k.level)];
    EXPECT_GE(std::min(k.x, k.y), 19.0F - 0.5F);
    EXPECT_LE(k.x, 640.0F - 19.0F);
    EXPECT_LE(k.y, 480.0F - 19.0F);
  }
  EXPECT_TRUE(std::is_sorted(per_level.rbegin(), per_level.rend()));
  EXPECT_GT(per_level.back(), 0);
}

TEST(OrbExtractor, SameFeaturesEachTimeAndForAnyNumberOfThreads) {
  const GrayImage image(Rectangles(400, 300, 2));
  const auto one = CreateOrbExtractor({}), three = CreateOrbExtractor({.num_threads = 3});
  const FeatureSet first = one->Extract(image);
  EXPECT_TRUE(SameFeatures(first, one->Extract(image)));
  EXPECT_TRUE(SameFeatures(first, three->Extract(image)));
  cv::setNumThreads(1);
  EXPECT_TRUE(SameFeatures(first, one->Extract(image)));
  cv::setNumThreads(-1);
}

// Each feature of an image must be found again, at the mapped place, in the image turned by 90
// degrees (which maps pixels onto pixels).
TEST(OrbExtractor, FeaturesTurnWithTheImage) {
  const cv::Mat image = Rectangles(320, 240, 4);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);  // (x, y) -> (h - 1 - y, x)
  const auto extractor =
      CreateOrbExtractor({.max_features = 2000, .num_levels = 1, .subpixel = false});
  const FeatureSet a = extractor->Extract(GrayImage(image));
  const FeatureSet b = extractor->Extract(GrayImage(turned));
  int found = 0, close = 0, angles_agree = 0;
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    const float x = 239.0F - a.keypoints[i].y, y = a.keypoints[i].x;
    for (std::size_t j = 0; j < b.keypoints.size(); ++j) {
      if (std::hypot(b.keypoints[j].x - x, b.keypoints[j].y - y) > 0.3F) continue;
      ++found;
      const double turn = b.keypoints[j].angle_rad - a.keypoints[i].angle_rad;
      angles_agree +=
          std::abs(std::remainder(turn - std::numbers::pi / 2, 2 * std::numbers::pi)) < 1e-3;
      close += DescriptorDistance(a.descriptors.kind(), a.descriptors.row(i),
                                  b.descriptors.row(j)) < 50.0F;
    }
  }
  EXPECT_GT(found, 0.7 * static_cast<double>(a.keypoints.size()));
  EXPECT_EQ(angles_agree, found);
  EXPECT_GT(close, 0.98 * found);
}

// Mirrored about its centre, (x, y) becomes (w - 1 - x, h - 1 - y). A level that forgets that the
// pixel's centre is its origin would put both features on the same side of the true place.
TEST(OrbExtractor, EveryLevelKeepsThePixelCentre) {
  const cv::Mat image = Rectangles(401, 300, 6);
  cv::Mat mirrored;
  cv::flip(image, mirrored, -1);
  const auto extractor = CreateOrbExtractor({.max_features = 4000});
  const FeatureSet a = extractor->Extract(GrayImage(image));
  const FeatureSet b = extractor->Extract(GrayImage(mirrored));
  std::array<std::vector<float>, 8> errors_x;
  for (const Keypoint& k : a.keypoints) {
    float nearest = 3.0F, error_x = 0.0F;
    for (const Keypoint& other : b.keypoints) {
      const float dx = 400.0F - other.x - k.x, dy = 299.0F - other.y - k.y;
      if (other.level != k.level || std::hypot(dx, dy) >= nearest) continue;
      nearest = std::hypot(dx, dy);
      error_x = dx;
    }
    if (nearest < 3.0F) errors_x[static_cast<std::size_t>(k.level)].push_back(error_x);
  }
  for (std::vector<float>& errors : errors_x) {
    ASSERT_GT(errors.size(), 10U);
    std::nth_element(errors.begin(), errors.begin() + static_cast<int>(errors.size() / 2),
                     errors.end());
    EXPECT_NEAR(errors[errors.size() / 2], 0.0F, 1e-3F);
  }
}

TEST(OrbExtractor, SmallDarkAndChangingImagesGiveSetsWithoutError) {
  const auto extractor = CreateOrbExtractor({.num_threads = 2});
  EXPECT_TRUE(extractor->Extract(GrayImage()).keypoints.empty());
  EXPECT_TRUE(
      extractor->Extract(GrayImage(cv::Mat(480, 640, CV_8UC1, cv::Scalar(0)))).keypoints.empty());
  for (const cv::Size size : {cv::Size(64, 48), cv::Size(1, 1), cv::Size(39, 39), cv::Size(38, 200),
                              cv::Size(700, 40), cv::Size(41, 500), cv::Size(640, 480)}) {
    const FeatureSet features =
        extractor->Extract(GrayImage(Rectangles(size.width, size.height, 5)));
    EXPECT_EQ(features.descriptors.size(), features.keypoints.size());
    EXPECT_EQ(features.descriptors.kind().name, "orb");
    EXPECT_EQ(features.keypoints.empty(),
              std::min(size.width, size.height) < 39 || size.width == 39)
        << size;
  }
}

TEST(OrbExtractor, RefusesImagesTooWideForItsPositions) {
  const auto extractor = CreateOrbExtractor({});
  EXPECT_THROW(extractor->Extract(GrayImage(cv::Mat(50, 32768, CV_8UC1, cv::Scalar(0)))),
               InputError);
  EXPECT_NO_THROW(extractor->Extract(GrayImage(cv::Mat(50, 32767, CV_8UC1, cv::Scalar(0)))));
}

TEST(OrbExtractor, RefusesOptionsOutOfRange) {
  EXPECT_THROW(CreateOrbExtractor({.num_levels = 0}), InputError);
  EXPECT_THROW(CreateOrbExtractor({.scale_factor = 1.0}), InputError);
  EXPECT_THROW(CreateOrbExtractor({.scale_factor = std::nan("")}), InputError);
  EXPECT_THROW(CreateOrbExtractor({.fast_threshold = 5, .min_fast_threshold = 7}), InputError);
  EXPECT_THROW(CreateOrbExtractor({.num_threads = 0}), InputError);
}

TEST(OrbExtractor, IdentityTellsOptionsApartThatChangeFeatures) {
  OrbOptions options;
  const std::string identity = OrbIdentity(options);
  options.num_threads = 2;
  options.sigma_px = 2.0;
  EXPECT_EQ(OrbIdentity(options), identity);
  options.fast_threshold = 30;
  EXPECT_NE(OrbIdentity(options), identity);
}

}  // namespace
}  // namespace lift_slam
