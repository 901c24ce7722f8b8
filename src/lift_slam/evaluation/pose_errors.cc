#include "lift_slam/evaluation/pose_errors.h"

#include <numbers>

namespace lift_slam {

std::vector<double> PositionErrorsM(std::span<const PosePair> aligned) {
  std::vector<double> errors;
  errors.reserve(aligned.size());
  for (const PosePair& pair : aligned) {
    errors.push_back((pair.estimate.translation - pair.reference.translation).norm());
  }
  return errors;
}

std::vector<double> RotationErrorsDeg(std::span<const PosePair> aligned) {
  std::vector<double> errors;
  errors.reserve(aligned.size());
  for (const PosePair& pair : aligned) {
    errors.push_back(RotationAngle(pair.reference.rotation.conjugate() * pair.estimate.rotation) *
                     180.0 / std::numbers::pi);
  }
  return errors;
}

}  // namespace lift_slam
