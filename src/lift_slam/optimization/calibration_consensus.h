#pragma once

#include <span>

#include "lift_slam/optimization/self_calibration.h"

namespace lift_slam {

// The correction that estimates from separate parts of a map agree on: their mean, drawn towards
// none by how much they differ. Each part's own uncertainty says nothing of wrong matches and
// drift, the difference between parts does: with an exact calibration the parts of a drive say
// anything from 0.98 to 1.2 (docs/accuracy.md), and all of them together 1.06. `parts` has at least
// two.
CalibrationCorrection Consensus(std::span<const CalibrationCorrection> parts,
                                const SelfCalibrationOptions& options);

}  // namespace lift_slam
