#include "lift_slam/simulation/motion/band_noise.h"

#include <cmath>
#include <numbers>

#include "lift_slam/util/check.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

constexpr int kNumWaves = 8;

}  // namespace

BandNoise::BandNoise(std::uint64_t seed, const NoiseBand& band, double rms) {
  LIFT_SLAM_CHECK(band.low > 0.0 && band.high >= band.low, "band {} to {}", band.low, band.high);
  Random random(seed);
  double power = 0.0;
  for (int i = 0; i < kNumWaves; ++i) {
    // One frequency in each of equal steps of the logarithm.
    const double share = (i + random.Uniform()) / kNumWaves;
    const double frequency = band.low * std::pow(band.high / band.low, share);
    const double amplitude = std::pow(frequency, -band.falloff);
    waves_.push_back({2.0 * std::numbers::pi * frequency,
                      random.Uniform(0.0, 2.0 * std::numbers::pi), amplitude});
    power += 0.5 * amplitude * amplitude;
  }
  for (Wave& wave : waves_) wave.amplitude *= rms / std::sqrt(power);
}

double BandNoise::Value(double x) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    sum += wave.amplitude * std::sin(wave.angular_frequency * x + wave.phase);
  }
  return sum;
}

double BandNoise::Derivative(double x) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    sum +=
        wave.amplitude * wave.angular_frequency * std::cos(wave.angular_frequency * x + wave.phase);
  }
  return sum;
}

// The finaliser of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators).
std::uint64_t MixSeeds(std::uint64_t seed, std::uint64_t stream) {
  std::uint64_t z = seed + 0x9E3779B97F4A7C15ULL * (stream + 1);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31);
}

}  // namespace lift_slam
