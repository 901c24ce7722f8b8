#pragma once

#include "lift_slam/image/image.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Salt-and-pepper noise: single pixels that are 0 or 255 whatever lies around them, as dead pixels
// or errors of transmission make them. A corner detector finds little else in such an image.
struct ImpulseNoiseOptions {
  bool remove = true;
  // Least share of pixels that stand out as salt, and as pepper, before an image counts as noisy.
  // Clean images: below 0.00003. Noise of 0.005 on streets: 0.001.
  double min_share = 0.0003;
  int min_difference = 40;  // grey levels that such a pixel is off all of its neighbours

  void Visit(OptionVisitor& visitor) {
    visitor.Field("remove", remove, "find salt-and-pepper noise and take it out of the image");
    visitor.Field("min_share", min_share,
                  "least share of pixels that stand out as salt, and as pepper, in a noisy image");
    visitor.Field("min_difference", min_difference,
                  "grey levels that a pixel of noise is off all of its neighbours");
  }
};

// What stands out in an image, as shares of its pixels.
struct ImpulseNoiseShares {
  double salt = 0.0, pepper = 0.0;
};

// Pixels of 255 (0) that are brighter (darker) than all of their eight neighbours by the least
// difference; neighbours of 0 or 255 say nothing. The difference is taken to the brightest
// (darkest) value in use besides 255 (0), so that truncated and overexposed images, where 255
// stands for everything above some value, have no salt.
ImpulseNoiseShares MeasureImpulseNoise(const GrayImage& image, const ImpulseNoiseOptions& options);

struct ImpulseNoiseResult {
  GrayImage image;        // the image given, pixels shared, when it is not noisy
  bool is_noisy = false;  // salt and pepper both stand out
  int num_replaced = 0;   // pixels
};

// Replaces the damaged pixels of a noisy image by the median of their undamaged neighbours (3 x 3,
// else 5 x 5) and leaves all others as they are. Damaged: 0 or 255, less than half of the
// neighbours have the same value, and their median is another grey.
ImpulseNoiseResult RemoveImpulseNoise(const GrayImage& image, const ImpulseNoiseOptions& options);

}  // namespace lift_slam
