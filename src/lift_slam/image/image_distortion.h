#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/image/image.h"

namespace lift_slam {

// Deliberate damage to images: the conditions of the paper's robustness experiments (sec. IV-D)
// and a few more. All of them work on the 8-bit image as it was read.
enum class ImageDistortionKind { kGamma, kQ1, kQ3, kQ1Clip, kQ3Clip, kSaltPepper, kNoise, kBlur };

struct ImageDistortion {
  ImageDistortionKind kind = ImageDistortionKind::kGamma;
  double amount = 1.0;  // exponent, share of pixels, grey levels or pixels; unused by q1 and q3
};

// A chain, in the order of the text: "gamma=0.25", "q3,salt-pepper=0.02".
//   gamma=G           255 (I / 255)^G, rounded: below 1 brighter, above 1 darker
//   q1, q3            truncation: values of at most the 25th percentile become 0 (q1); values of
//                     at least the 75th become 255 (q3)
//   q1-clip, q3-clip  values beyond the percentile become the percentile
//   salt-pepper=P     a share P of the pixels becomes 0 or 255
//   noise=SIGMA       normal noise, grey levels
//   blur=SIGMA        Gaussian blur, pixels
// Throws InputError with one sentence.
std::vector<ImageDistortion> ParseImageDistortions(std::string_view text);

// The text again, in one form only: "gamma=0.25,q1".
std::string ToText(std::span<const ImageDistortion> chain);

// The smallest value that at least this share of the pixels does not exceed; 0 when empty.
std::uint8_t GrayQuantile(const GrayImage& image, double share);

// The chain applied. What is random depends on the seed and the frame's number alone.
GrayImage Distort(const GrayImage& image, std::span<const ImageDistortion> chain,
                  std::uint64_t seed, std::int64_t frame_index);

}  // namespace lift_slam
