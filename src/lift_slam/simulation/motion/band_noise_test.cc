#include "lift_slam/simulation/motion/band_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lift_slam {
namespace {

double Rms(const BandNoise& noise, double step, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += noise.Value(i * step) * noise.Value(i * step);
  return std::sqrt(sum / count);
}

TEST(BandNoise, HasTheRootMeanSquareAskedFor) {
  EXPECT_NEAR(Rms(BandNoise(1, {0.5, 8.0, 1.0}, 0.02), 0.013, 20000), 0.02, 0.001);
}

TEST(BandNoise, DerivativeFitsDifferences) {
  const BandNoise noise(2, {0.5, 8.0, 0.0}, 1.0);
  for (double x = 0.0; x < 5.0; x += 0.31) {
    const double difference = (noise.Value(x + 1e-5) - noise.Value(x - 1e-5)) / 2e-5;
    EXPECT_NEAR(noise.Derivative(x), difference, 1e-5);
  }
}

TEST(BandNoise, StaysWithinItsBand) {
  const BandNoise noise(3, {2.0, 4.0, 0.0}, 1.0);
  const double step = 1e-3;
  int crossings = 0;
  for (int i = 0; i < 100000; ++i) {
    crossings += (noise.Value(i * step) < 0.0) != (noise.Value((i + 1) * step) < 0.0) ? 1 : 0;
  }
  EXPECT_GT(crossings, 2 * 2 * 100);  // 100 s, two crossings a cycle
  EXPECT_LT(crossings, 2 * 4 * 100);
}

TEST(BandNoise, SameSeedSameValuesOtherSeedOthers) {
  const NoiseBand band = {0.5, 8.0, 1.0};
  EXPECT_EQ(BandNoise(4, band, 1.0).Value(12.5), BandNoise(4, band, 1.0).Value(12.5));
  EXPECT_NE(BandNoise(4, band, 1.0).Value(12.5), BandNoise(5, band, 1.0).Value(12.5));
  EXPECT_EQ(BandNoise().Value(1.0), 0.0);
}

TEST(MixSeeds, TellsSeedsAndStreamsApart) {
  EXPECT_EQ(MixSeeds(1, 2), MixSeeds(1, 2));
  EXPECT_NE(MixSeeds(1, 2), MixSeeds(2, 1));
  EXPECT_NE(MixSeeds(0, 0), MixSeeds(0, 1));
}

}  // namespace
}  // namespace lift_slam
