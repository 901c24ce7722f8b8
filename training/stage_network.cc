#include "training/stage_network.h"

namespace lift_slam::training {

void TakeNetwork(Stage stage, const LiftWeights& from, LiftWeights& to) {
  switch (stage) {
    case Stage::kDescriptor:
      to.descriptor = from.descriptor;
      to.descriptor_input = from.descriptor_input;
      return;
    case Stage::kOrientation:
      to.orientation = from.orientation;
      to.orientation_input = from.orientation_input;
      return;
    case Stage::kDetector:
      to.detector = from.detector;
      to.detector_input = from.detector_input;
  }
}

}  // namespace lift_slam::training
