#pragma once

#include <cstdint>
#include <vector>

namespace lift_slam {

// What a smooth noise is made of; frequencies in cycles per unit of its argument (Hz of a time,
// 1/m of a distance).
struct NoiseBand {
  double low = 0.5;
  double high = 8.0;     // >= low
  double falloff = 1.0;  // amplitudes go with frequency ^ -falloff
};

// Smooth seeded noise of one variable: a sum of sinusoids with frequencies spread over a band
// and random phases. It has derivatives of every order and does not repeat.
class BandNoise {
 public:
  // Zero everywhere.
  BandNoise() = default;
  // `rms`: root mean square over a long time. The largest value ever is below 4 * rms for a
  // falloff of 0.
  BandNoise(std::uint64_t seed, const NoiseBand& band, double rms);

  double Value(double x) const;
  double Derivative(double x) const;

 private:
  struct Wave {
    double angular_frequency, phase, amplitude;
  };
  std::vector<Wave> waves_;
};

// A seed of its own for each use of one seed: the same bits for the same two numbers.
std::uint64_t MixSeeds(std::uint64_t seed, std::uint64_t stream);

}  // namespace lift_slam
