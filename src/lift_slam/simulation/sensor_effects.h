#pragma once

#include <cstdint>

#include "lift_slam/simulation/light_image.h"
#include "lift_slam/simulation/sensor_options.h"

namespace lift_slam {

// The effects of a sensor one by one; all seeded and without memory, so that any frame can be made
// alone.

// Light falls off by `loss` in the corners, with the square of the distance from the image centre.
void ApplyVignetting(double loss, LightImage& image);

void ApplyGain(double gain, LightImage& image);

// Shot noise, whose variance goes with the light, and read-out noise; both as normal
// distributions.
void ApplyNoise(const NoiseOptions& options, std::uint64_t seed, LightImage& image);

// A share of the pixels becomes black or white, all channels alike.
void ApplySaltAndPepper(double share, std::uint64_t seed, ByteImage& image);

// Factor on the light at a time: 2 ^ (swing + jump). Jumps come once in each interval of
// jump_interval_s, at a random place of it.
double ExposureGain(const ExposureOptions& options, std::uint64_t seed, double time_s);

double GammaAt(const SensorOptions& options, double time_s);

// Whether the light of a frame has to be worked on at all after it was gathered.
bool ChangesLight(const SensorOptions& options);

// From gathered light (motion blur and rolling shutter are in it) to the pixels: vignetting,
// exposure, noise, tone curve, rounding, then salt and pepper. `seed` is the sequence's, `frame`
// its number; the same for the same arguments.
ByteImage DevelopFrame(LightImage light, const SensorOptions& options, std::uint64_t seed,
                       int frame, double time_s);

}  // namespace lift_slam
