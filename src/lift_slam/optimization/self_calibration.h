#pragma once

#include <string_view>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/optimization/bundle_adjustment.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// What a given calibration is off by: a point that the ideal pinhole sees at normalised (x, y) is
// measured at focal_scale * (1 + k1 (x^2 + y^2)) * (x, y).
struct CalibrationCorrection {
  double focal_scale = 1.0;
  double k1 = 0.0;

  bool IsIdentity() const { return focal_scale == 1.0 && k1 == 0.0; }
  // The pixel an ideal pinhole would have measured, from the (undistorted) pixel that was.
  Eigen::Vector2d ToIdeal(const PinholeIntrinsics& intrinsics, const Eigen::Vector2d& pixel) const;
};

struct SelfCalibrationOptions {
  bool enabled = true;
  // How far a calibration is usually off, as standard deviations of a prior around "not at all":
  // KITTI's residual distortion (Cvisic et al., 2021) is of this size.
  double focal_scale_sigma = 0.01;
  double k1_sigma = 0.01;
  // What estimates of an exact calibration are off by, as standard deviations (docs/scale.md):
  // wrong matches and drift say so much. A calibration that is not clearly further off is left as
  // it is.
  double focal_scale_error = 0.005;
  double k1_error = 0.002;
  int min_keyframes = 20;  // fewer say too little
  // Maps of more keyframes are calibrated on so many, in windows of consecutive ones spread over
  // the map: enough for two unknowns, and the time no longer grows with the map.
  int max_keyframes = 400;
  int window_keyframes = 50;  // at most half of max_keyframes: two have to agree
  int max_iterations = 30;
  double function_tolerance = 1e-5;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("enabled", enabled, "correct the calibration when the input has ended");
    visitor.Field("focal_scale_sigma", focal_scale_sigma,
                  "prior standard deviation of the focal length, as a ratio");
    visitor.Field("k1_sigma", k1_sigma, "prior standard deviation of the radial distortion k1");
    visitor.Field("focal_scale_error", focal_scale_error,
                  "error of the estimate, as a ratio; what is not clearly more is not corrected");
    visitor.Field("k1_error", k1_error, "the same of k1");
    visitor.Field("min_keyframes", min_keyframes, "keyframes a map needs for it");
    visitor.Field("max_keyframes", max_keyframes,
                  "keyframes it takes at most, spread over the map");
    visitor.Field("window_keyframes", window_keyframes, "consecutive keyframes of one estimate");
    visitor.Field("max_iterations", max_iterations, "iterations of the solver at most");
    visitor.Field("function_tolerance", function_tolerance,
                  "relative change of the cost that ends the solver");
  }
};

// Whether a correction is more than an estimate's error (chi-square, 2 dof, 99 %).
bool IsClearlyOff(const CalibrationCorrection& correction, const SelfCalibrationOptions& options);

// The observations' pixels become those that the ideal pinhole would have measured.
void MakePixelsIdeal(const CalibrationCorrection& correction, BundleProblem& problem);

// Why a calibration was left as given, or (kNone) that it was corrected.
enum class CalibrationRefusal {
  kNone,
  kNotReached,  // the run ended before, or the map is an earlier run's
  kSwitchedOff,
  kFewKeyFrames,  // fewer than min_keyframes
  kNoEstimate,    // the solver, or all but one of the windows, gave none
  kNotClearlyOff,
  kCount
};

// Lower-case words with underscores, as in result.json: "not_clearly_off".
std::string_view Name(CalibrationRefusal refusal);
// One sentence for people.
std::string_view Explain(CalibrationRefusal refusal);

struct SelfCalibrationReport {
  CalibrationRefusal refusal = CalibrationRefusal::kNotReached;
  CalibrationCorrection estimate = {};  // what was found, taken or (kNotClearlyOff) not
  double initial_cost = 0.0, final_cost = 0.0;
  int iterations = 0;

  bool usable() const { return refusal == CalibrationRefusal::kNone; }
  // What pixels are to be corrected by: the identity where the calibration was left as given.
  CalibrationCorrection correction() const { return usable() ? estimate : CalibrationCorrection(); }
};

// Bundle adjustment of poses, points and the calibration's correction together, with a Huber loss
// and a prior on the correction. Poses and points of `problem` are moved, its pixels become those
// of the ideal pinhole. When refused (kNoEstimate), `problem` is unchanged.
SelfCalibrationReport SelfCalibrate(BundleProblem& problem, const SelfCalibrationOptions& options);

}  // namespace lift_slam
