#include "lift_slam/simulation/sensor_effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

ByteImage AllValues() {
  ByteImage image{256, 1, 1, std::vector<std::uint8_t>(256)};
  std::iota(image.values.begin(), image.values.end(), std::uint8_t{0});
  return image;
}

LightImage Flat(int width, int height, float light) {
  return {width, height, 1, std::vector<float>(static_cast<std::size_t>(width * height), light)};
}

TEST(Develop, IsTheInverseOfToLightForEveryValue) {
  EXPECT_EQ(Develop(ToLight(AllValues()), kSceneGamma).values, AllValues().values);
}

TEST(Develop, CutsOffLightBeyondWhite) {
  EXPECT_EQ(Develop(Flat(1, 1, 3.0F), 2.2).values[0], 255);
  EXPECT_EQ(Develop(Flat(1, 1, -0.1F), 2.2).values[0], 0);
}

TEST(DevelopFrame, OfASensorWithoutEffectsChangesNothing) {
  EXPECT_FALSE(ChangesLight({}));
  EXPECT_EQ(DevelopFrame(ToLight(AllValues()), {}, 1, 5, 2.0).values, AllValues().values);
}

TEST(ApplyVignetting, DarkensTheCornersAsAsked) {
  LightImage image = Flat(65, 49, 0.8F);
  ApplyVignetting(0.5, image);
  EXPECT_NEAR(image.values[0], 0.4F, 1e-6);
  EXPECT_NEAR(image.values[24 * 65 + 32], 0.8F, 1e-6);
  EXPECT_NEAR(image.values[64], image.values[48 * 65], 1e-6);
}

TEST(ApplyNoise, ShotNoiseGrowsWithTheRootOfTheLight) {
  const NoiseOptions options = {1000.0, 0.0};
  for (const float light : {0.1F, 0.4F}) {
    LightImage image = Flat(200, 200, light);
    ApplyNoise(options, 7, image);
    double square = 0.0, sum = 0.0;
    for (const float value : image.values) {
      sum += value - light;
      square += std::pow(value - light, 2);
    }
    const auto count = static_cast<double>(image.values.size());
    EXPECT_NEAR(std::sqrt(square / count), std::sqrt(light / 1000.0), 3e-4);
    EXPECT_NEAR(sum / count, 0.0, 5e-4);
  }
}

TEST(ApplyNoise, ReadNoiseIsThereInTheDark) {
  LightImage image = Flat(200, 200, 0.0F);
  ApplyNoise({1000.0, 5.0}, 7, image);
  double square = 0.0;
  for (const float value : image.values) square += value * value;
  EXPECT_NEAR(std::sqrt(square / 40000.0), 0.005, 2e-4);
}

TEST(ApplyNoise, DependsOnItsSeedAlone) {
  LightImage a = Flat(20, 20, 0.5F), b = a, c = a;
  ApplyNoise({1000.0, 5.0}, 1, a);
  ApplyNoise({1000.0, 5.0}, 1, b);
  ApplyNoise({1000.0, 5.0}, 2, c);
  EXPECT_EQ(a.values, b.values);
  EXPECT_NE(a.values, c.values);
}

TEST(ApplySaltAndPepper, HitsItsShareHalfBlackHalfWhite) {
  ByteImage image{300, 300, 3, std::vector<std::uint8_t>(270000, 128)};
  ApplySaltAndPepper(0.1, 3, image);
  int black = 0, white = 0, torn = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    black += image.values[i] == 0 ? 1 : 0;
    white += image.values[i] == 255 ? 1 : 0;
    torn +=
        image.values[i] != image.values[i + 1] || image.values[i] != image.values[i + 2] ? 1 : 0;
  }
  EXPECT_NEAR(black, 4500, 300);
  EXPECT_NEAR(white, 4500, 300);
  EXPECT_EQ(torn, 0);
}

TEST(ExposureGain, SwingsSlowlyAroundOne) {
  ExposureOptions options;
  options.swing_ev = 1.0;
  options.swing_period_s = 8.0;
  EXPECT_NEAR(ExposureGain(options, 1, 0.0), 1.0, 1e-9);
  EXPECT_NEAR(ExposureGain(options, 1, 2.0), 2.0, 1e-9);
  EXPECT_NEAR(ExposureGain(options, 1, 6.0), 0.5, 1e-9);
  EXPECT_EQ(ExposureGain({}, 1, 6.0), 1.0);
}

TEST(ExposureGain, JumpsOnceInEachInterval) {
  ExposureOptions options;
  options.jump_ev = 1.5;
  options.jump_interval_s = 5.0;
  int jumps = 0;
  double before = ExposureGain(options, 4, 0.0);
  EXPECT_EQ(before, 1.0);
  for (double t = 0.01; t < 50.0; t += 0.01) {
    const double gain = ExposureGain(options, 4, t);
    EXPECT_LE(std::abs(std::log2(gain)), 1.5);
    jumps += gain != before ? 1 : 0;
    before = gain;
  }
  EXPECT_EQ(jumps, 10);
}

// A gain of 4 after vignetting cannot bring back what noise and rounding lost: the order counts.
TEST(DevelopFrame, AppliesGainBeforeNoiseAndToneCurve) {
  SensorOptions options;
  options.exposure.swing_ev = 2.0;
  options.exposure.swing_period_s = 4.0;
  const LightImage light = Flat(4, 4, 0.2F);
  const ByteImage image = DevelopFrame(light, options, 1, 0, 1.0);  // 4 times the light
  EXPECT_NEAR(image.values[0], 255.0 * std::pow(0.8, 1.0 / 2.2), 1.0);
  options.gamma = 1.0;
  EXPECT_NEAR(DevelopFrame(light, options, 1, 0, 1.0).values[0], 204, 1);
}

TEST(GammaAt, Swings) {
  SensorOptions options;
  options.gamma_swing = 0.4;
  options.gamma_period_s = 4.0;
  EXPECT_NEAR(GammaAt(options, 1.0), 2.6, 1e-9);
  EXPECT_NEAR(GammaAt(options, 3.0), 1.8, 1e-9);
}

TEST(SensorOptions, RefuseWhatCannotBe) {
  SensorOptions options;
  options.motion_blur.samples = 4;
  EXPECT_THROW(options.Check(), InputError);
  options = {};
  options.vignetting = 1.5;
  EXPECT_THROW(options.Check(), InputError);
  options = {};
  options.salt_and_pepper = -0.1;
  EXPECT_THROW(options.Check(), InputError);
  EXPECT_NO_THROW(SensorOptions().Check());
}

}  // namespace
}  // namespace lift_slam
