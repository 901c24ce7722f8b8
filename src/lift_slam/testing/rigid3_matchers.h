#pragma once

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <numbers>

#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// EXPECT_THAT(pose, Rigid3dNear(expected, /*rotation_tolerance_deg=*/0.1,
//                               /*translation_tolerance=*/0.01));
// The failure message names both differences.
MATCHER_P3(Rigid3dNear, expected, rotation_tolerance_deg, translation_tolerance,
           "is within " + testing::PrintToString(rotation_tolerance_deg) + " degrees and " +
               testing::PrintToString(translation_tolerance) + " of the expected transform") {
  const double rotation_deg =
      RotationAngle(arg.rotation * expected.rotation.conjugate()) * 180.0 / std::numbers::pi;
  const double translation = (arg.translation - expected.translation).norm();
  *result_listener << "differs by " << rotation_deg << " degrees and " << translation;
  return rotation_deg <= rotation_tolerance_deg && translation <= translation_tolerance;
}

}  // namespace lift_slam
