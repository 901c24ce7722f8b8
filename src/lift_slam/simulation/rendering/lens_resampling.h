#pragma once

#include <cstdint>
#include <vector>

#include "lift_slam/simulation/rendering/lens_map.h"
#include "lift_slam/simulation/rendering/render_target.h"

namespace lift_slam {

// RGB of each pixel: the mean of its samples, each interpolated in its view; black where the
// camera has no rays. views: the samples of map.views, in that order.
std::vector<std::uint8_t> ResampleColor(const LensMap& map, const std::vector<Samples>& views);

// z in the camera frame of what each pixel's centre sees; 0: nothing there. Exact on planes,
// nearest sample at edges.
std::vector<float> ResampleDepth(const LensMap& map, const std::vector<Samples>& views,
                                 const DepthRange& range);

}  // namespace lift_slam
