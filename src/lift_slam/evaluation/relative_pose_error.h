#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lift_slam/evaluation/association.h"
#include "lift_slam/evaluation/error_statistics.h"

namespace lift_slam {

// Relative pose error: for pose pairs (i, j), E = (G_i^-1 G_j)^-1 (E_i^-1 E_j).
struct RelativePoseError {
  ErrorStatistics translation_m;  // norm of E's translation
  ErrorStatistics rotation_deg;   // angle of E's rotation
};

// The pairs (i, j), i < j, as positions in `aligned`. In frames: `frame_of_pair` counts the frames
// of the sequence, so that a gap never passes for one step; pairs are `delta` frames apart. In
// metres: j is the first pose at least delta along the path; consecutive pairs run between marks
// set each time delta metres have passed since the last mark, the start itself being none.
std::vector<std::pair<std::size_t, std::size_t>> ChooseRpePairs(
    std::span<const PosePair> aligned, std::span<const std::int64_t> frame_of_pair,
    const RpeOptions& options);

// Nothing when the trajectory is too short for a single pair.
std::optional<RelativePoseError> ComputeRelativePoseError(
    std::span<const PosePair> aligned, std::span<const std::int64_t> frame_of_pair,
    const RpeOptions& options);

}  // namespace lift_slam
