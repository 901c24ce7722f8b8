#pragma once

#include <cstdint>
#include <random>

namespace lift_slam {

// Seeded random numbers, the same on every platform (the distributions of <random> are not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t Bits() { return engine_(); }
  // Uniform in [0, 1).
  double Uniform();
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }
  // Uniform in [low, high], both included; high >= low.
  int UniformInt(int low, int high);
  // Normal with mean 0 and standard deviation 1 (Box-Muller).
  double Normal();

 private:
  std::mt19937_64 engine_;
};

}  // namespace lift_slam
