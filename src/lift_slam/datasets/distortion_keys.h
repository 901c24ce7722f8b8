#pragma once

#include <string>
#include <vector>

#include "lift_slam/datasets/keyed_file.h"

namespace lift_slam {

// Keys of a camera file that name a distortion but are not those that are read: taken no notice
// of, the camera would silently be one without distortion. Values that are all zero may stand.

// Throws InputError for a key `prefix` + "dist..." (in any case) whose name is not `known`.
void RefuseOtherDistortionKeys(const KeyedFile& file, const std::string& prefix,
                               const std::vector<std::string>& known);

// ORB-SLAM: throws InputError for a key such as Camera.K1, Camera.k4 or Camera.distCoeffs (in any
// case) that is not `prefix` + one of `known`.
void RefuseOtherOrbSlamCoefficients(const KeyedFile& file, const std::string& prefix,
                                    const std::vector<std::string>& known);

}  // namespace lift_slam
