#pragma once

#include <span>

#include "lift_slam/optimization/self_calibration.h"

namespace lift_slam {

// The correction that estimates from separate parts of a map agree on: their mean, drawn towards
// none by how much they differ. A part's own uncertainty says nothing of wrong matches and drift,
// the difference between parts does: all parts of a drive in one estimate were found to say 1.06
// of an exact calibration (docs/scale.md). `parts` has at least two.
CalibrationCorrection Consensus(std::span<const CalibrationCorrection> parts,
                                const SelfCalibrationOptions& options);

}  // namespace lift_slam
