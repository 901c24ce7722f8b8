#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lift_slam/evaluation/association.h"

namespace lift_slam {

// How the scale of a monocular trajectory changes along the way. The way (reference path) is cut
// into equal pieces; the scale of a piece is the reference's length over the estimate's, both as
// sums of chords of at least a fiftieth of the piece, so that jitter from frame to frame does not
// count as way.
struct ScaleDrift {
  std::vector<double> scale_of_piece;  // in order, relative to the median piece
  double last_over_first = 1.0;        // 1: no drift between the ends
  double largest_over_smallest = 1.0;  // 1: no drift anywhere
};

inline constexpr int kScaleDriftPieces = 10;

// Nothing when the reference stands still or a piece holds fewer than two chords.
std::optional<ScaleDrift> ComputeScaleDrift(std::span<const PosePair> pairs);

}  // namespace lift_slam
