#include "lift_slam/simulation/rendering/downsampling.h"

#include <gtest/gtest.h>

namespace lift_slam {
namespace {

constexpr PinholeIntrinsics kPinhole = {50.0, 60.0, 3.2, 2.1, 7, 5};

TEST(Downsampling, OneSampleLiesOnEachPixelCenter) {
  for (const int s : {1, 2, 3, 4, 5}) {
    const PinholeIntrinsics fine = SamplePinhole(kPinhole, s);
    const Eigen::Vector3d ray = kPinhole.Unproject({4.0, 1.0});
    const Eigen::Vector2d sample = fine.Project(ray);
    EXPECT_NEAR(sample.x(), CenterSample(4, s), 1e-9) << s;
    EXPECT_NEAR(sample.y(), CenterSample(1, s), 1e-9) << s;
  }
}

TEST(Downsampling, KeepsEvenColors) {
  for (const int s : {1, 2, 3, 8}) {
    const PinholeIntrinsics fine = SamplePinhole(kPinhole, s);
    std::vector<std::uint8_t> samples;
    for (int i = 0; i < fine.width * fine.height; ++i)
      samples.insert(samples.end(), {255, 7, 100, 0});
    const auto rgb = DownsampleColor(samples, kPinhole, s);
    ASSERT_EQ(rgb.size(), 3U * 7U * 5U);
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
      ASSERT_EQ(rgb[i], 255) << s;
      ASSERT_EQ(rgb[i + 1], 7) << s;
      ASSERT_EQ(rgb[i + 2], 100) << s;
    }
  }
}

TEST(Downsampling, KeepsTheSumOfASinglePoint) {
  // Wherever a lit sample lies, the pixels it falls into receive its light once (s = 2: a quarter).
  const PinholeIntrinsics fine = SamplePinhole(kPinhole, 2);
  for (const int column : {5, 6, 7}) {
    std::vector<std::uint8_t> samples(4 * static_cast<std::size_t>(fine.width * fine.height));
    samples[4 * static_cast<std::size_t>(5 * fine.width + column)] = 240;
    int sum = 0;
    for (const std::uint8_t value : DownsampleColor(samples, kPinhole, 2)) sum += value;
    EXPECT_EQ(sum, 60) << column;
  }
}

TEST(Downsampling, TakesTheDepthOfTheCenter) {
  const DepthRange range{0.5, 100.0};
  const PinholeIntrinsics fine = SamplePinhole(kPinhole, 2);
  std::vector<float> samples(static_cast<std::size_t>(fine.width * fine.height), 0.0F);
  samples[static_cast<std::size_t>(CenterSample(3, 2) * fine.width + CenterSample(6, 2))] = 1.0F;
  const auto depth = CenterDepth(samples, kPinhole, 2, range);
  EXPECT_NEAR(depth[3 * 7 + 6], 0.5, 1e-6);  // 1 in the buffer: the near plane
  EXPECT_EQ(depth[3 * 7 + 5], 0.0F);
}

}  // namespace
}  // namespace lift_slam
