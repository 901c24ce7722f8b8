#pragma once

#include <string>

#include "lift_slam/features/feature_extractor.h"

namespace lift_slam {

// The image with its keypoints drawn, as the bytes of a PNG file: circles of twice the scale of
// their level with a line in the direction of their angle.
std::string KeypointPicture(const GrayImage& image, const FeatureSet& features,
                            const ScaleLevels& levels);

}  // namespace lift_slam
