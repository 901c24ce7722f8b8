#pragma once

#include <cstdint>
#include <span>

#include "lift_slam/util/options.h"
#include "lift_slam/util/random.h"

namespace lift_slam::training {

// Changes of light and camera, drawn for each patch on its own.
struct PhotometryOptions {
  double max_gamma = 4.0;       // grey^gamma, log-uniform between 1 / max_gamma and max_gamma
  double gamma_share = 0.4;     // of the patches; the others: between 1 / 1.4 and 1.4
  double max_gain = 1.5;        // log-uniform between 1 / max_gain and max_gain
  double max_offset = 25.0;     // grey values, uniform, either way
  double max_noise = 6.0;       // standard deviation, grey values; uniform from 0
  double blurred_share = 0.25;  // of the patches: smoothed once or twice by (1, 2, 1) / 4
  void Visit(OptionVisitor& visitor);
  void Check() const;  // throws InputError naming the field
};

// Changes a square patch in place: blur, gamma, gain, offset, noise, rounding and clipping to 8
// bit, as a camera would.
void ChangeLight(std::span<std::uint8_t> patch, int size, const PhotometryOptions& options,
                 Random& random);

}  // namespace lift_slam::training
