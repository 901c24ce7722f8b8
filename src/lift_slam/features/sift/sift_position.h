#pragma once

namespace lift_slam {

// What to add to x and y of OpenCV's SIFT keypoints, pixels: it (before 4.8) doubles the image
// about pixel centres, but halves the positions about the image's corner.
inline constexpr float kSiftPositionOffsetPx = -0.25F;

}  // namespace lift_slam
