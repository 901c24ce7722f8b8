#pragma once

#include <span>
#include <string>

#include "lift_slam/features/image_pair.h"

namespace lift_slam {

// Two images with lines between their matches, as the bytes of a PNG file: inliers green, outliers
// orange and below them; wide images one above the other, others side by side, small ones enlarged.
// The captions go above, one line each, in letters that fit the width.
std::string MatchPicture(const GrayImage& image_a, const GrayImage& image_b, const FeatureSet& a,
                         const FeatureSet& b, std::span<const ImagePairMatch> matches,
                         std::span<const std::string> captions);

}  // namespace lift_slam
