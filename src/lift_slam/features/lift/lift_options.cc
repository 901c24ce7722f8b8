#include "lift_slam/features/lift/lift_options.h"

#include "lift_slam/util/option_range.h"

namespace lift_slam {
void LiftExtractorOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("max_features", max_features, "features per image, spread over it; 0: all found");
  visitor.Field("candidate_ratio", candidate_ratio,
                "they are spread over the image from this many times as many, the strongest");
  visitor.Group("detector", detector, "maxima of the detector's scores");
  visitor.Field(
      "precision", precision, nn::kPrecisionNames,
      "arithmetic of descriptor and orientation, where the CPU has it; auto: the fastest");
  visitor.Field("upright", upright, "patches are not turned (no orientation network)");
  visitor.Field("sigma_px", sigma_px, "noise of the position of a keypoint of sigma 1");
  visitor.Field("low_threshold", low_threshold,
                "fixed strict distance of descriptors; 0: as measured with the weights, or 2");
  visitor.Field("high_threshold", high_threshold,
                "fixed loose distance of descriptors; 0: as measured with the weights, or 3");
  visitor.Field("num_threads", num_threads, "threads of one image; 0: all");
}

void LiftExtractorOptions::Check() const {
  detector.Check();
  CheckOptionRange("lift.max_features", max_features, 0, 100000);
  CheckOptionRange("lift.candidate_ratio", candidate_ratio, 1.0, 1e3);
  CheckOptionRange("lift.sigma_px", sigma_px, 0.01, 100.0);
  CheckOptionRange("lift.low_threshold", low_threshold, 0.0, 1e6);
  CheckOptionRange("lift.high_threshold", high_threshold, 0.0, 1e6);
  CheckOptionRange("lift.num_threads", num_threads, 0, 64);
}

}  // namespace lift_slam
