#include "lift_slam/simulation/sensor_effects.h"

#include <cmath>
#include <numbers>

#include "lift_slam/simulation/motion/band_noise.h"
#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

enum SeedStream : std::uint64_t { kExposure = 300, kNoise, kSaltAndPepper };

double Swing(double amplitude, double period_s, double time_s) {
  return amplitude * std::sin(2.0 * std::numbers::pi * time_s / period_s);
}

// The level that holds after the jump within interval `index`.
double JumpLevel(const ExposureOptions& options, std::uint64_t seed, std::int64_t index,
                 double* jump_time_s) {
  Random random(MixSeeds(seed, static_cast<std::uint64_t>(index)));
  *jump_time_s = (static_cast<double>(index) + random.Uniform()) * options.jump_interval_s;
  return random.Uniform(-options.jump_ev, options.jump_ev);
}

double JumpAt(const ExposureOptions& options, std::uint64_t seed, double time_s) {
  if (options.jump_ev == 0.0) return 0.0;
  const auto index = static_cast<std::int64_t>(std::floor(time_s / options.jump_interval_s));
  double jump_time_s = 0.0;
  const double level = JumpLevel(options, seed, index, &jump_time_s);
  if (time_s >= jump_time_s) return level;
  return index == 0 ? 0.0 : JumpLevel(options, seed, index - 1, &jump_time_s);
}

}  // namespace

void ApplyVignetting(double loss, LightImage& image) {
  if (loss == 0.0) return;
  const double center_x = 0.5 * (image.width - 1), center_y = 0.5 * (image.height - 1);
  const double corner = std::max(center_x * center_x + center_y * center_y, 1.0);
  std::size_t at = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double dx = x - center_x, dy = y - center_y;
      const auto factor = static_cast<float>(1.0 - loss * (dx * dx + dy * dy) / corner);
      for (int c = 0; c < image.channels; ++c) image.values[at++] *= factor;
    }
  }
}

void ApplyGain(double gain, LightImage& image) {
  if (gain == 1.0) return;
  for (float& value : image.values) value *= static_cast<float>(gain);
}

void ApplyNoise(const NoiseOptions& options, std::uint64_t seed, LightImage& image) {
  if (options.full_well_electrons == 0.0) return;
  Random random(seed);
  const double read = options.read_electrons / options.full_well_electrons;
  for (float& value : image.values) {
    const double shot = std::max(0.0, static_cast<double>(value)) / options.full_well_electrons;
    value += static_cast<float>(std::sqrt(shot + read * read) * random.Normal());
  }
}

void ApplySaltAndPepper(double share, std::uint64_t seed, ByteImage& image) {
  if (share == 0.0) return;
  Random random(seed);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t at = 0; at < image.values.size(); at += channels) {
    const double draw = random.Uniform();
    if (draw >= share) continue;
    const std::uint8_t value = draw < 0.5 * share ? 0 : 255;
    for (std::size_t c = 0; c < channels; ++c) image.values[at + c] = value;
  }
}

double ExposureGain(const ExposureOptions& options, std::uint64_t seed, double time_s) {
  const double swing = Swing(options.swing_ev, options.swing_period_s, time_s);
  return std::exp2(swing + JumpAt(options, MixSeeds(seed, kExposure), time_s));
}

double GammaAt(const SensorOptions& options, double time_s) {
  return options.gamma + Swing(options.gamma_swing, options.gamma_period_s, time_s);
}

bool ChangesLight(const SensorOptions& options) {
  return options.vignetting > 0.0 || options.exposure.swing_ev > 0.0 ||
         options.exposure.jump_ev > 0.0 || options.noise.full_well_electrons > 0.0 ||
         options.gamma != kSceneGamma || options.gamma_swing > 0.0;
}

ByteImage DevelopFrame(LightImage light, const SensorOptions& options, std::uint64_t seed,
                       int frame, double time_s) {
  // Grey and colour pictures are of two cameras: their noise differs.
  const std::uint64_t frame_seed = MixSeeds(
      seed, 8 * static_cast<std::uint64_t>(frame) + static_cast<std::uint64_t>(light.channels));
  ApplyVignetting(options.vignetting, light);
  ApplyGain(ExposureGain(options.exposure, seed, time_s), light);
  ApplyNoise(options.noise, MixSeeds(frame_seed, kNoise), light);
  ByteImage image = Develop(light, GammaAt(options, time_s));
  ApplySaltAndPepper(options.salt_and_pepper, MixSeeds(frame_seed, kSaltAndPepper), image);
  return image;
}

}  // namespace lift_slam
