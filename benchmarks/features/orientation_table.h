#pragma once

#include <span>
#include <string>

#include "benchmarks/features/quality_tables.h"

namespace lift_slam {

// Turned copies of each set's first images: the median difference, in degrees, between the turn of
// the image and that of the angle the orientation network gives SIFT's keypoints, and the share of
// them below 10 and 20 degrees; "-" where there are no such keypoints. Weights without that network
// have no row.
std::string OrientationTable(std::span<const NamedWeights> all, std::span<const ImageSet> sets,
                             const QualityOptions& options);

}  // namespace lift_slam
