#pragma once

namespace lift_slam {

// Points nearer to the image plane than this, or behind it, are not seen (map units along z). Far
// below any depth of a map, whose scale is set near 1 at its start; keeps 1 / z^2 finite.
inline constexpr double kMinDepth = 1e-6;

}  // namespace lift_slam
