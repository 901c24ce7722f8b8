#include "lift_slam/util/random.h"

#include <cmath>
#include <numbers>

namespace lift_slam {

double Random::Uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

int Random::UniformInt(int low, int high) {
  const auto span = static_cast<std::uint64_t>(high - low) + 1;
  return low + static_cast<int>(engine_() % span);
}

double Random::Normal() {
  const double u1 = 1.0 - Uniform();  // in (0, 1]: the logarithm is finite
  const double u2 = Uniform();
  return std::sqrt(-2.0 * std::log(u1)) * std::cos(2.0 * std::numbers::pi * u2);
}

}  // namespace lift_slam
