#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct BundleObservation {
  int camera = 0;                 // index into cams_from_world
  int point = 0;                  // index into points
  Eigen::Vector2d pixel;          // undistorted
  double inverse_variance = 1.0;  // 1 / sigma^2 of the pixel, 1 / px^2, of x and of y
};

struct BundleProblem {
  PinholeIntrinsics intrinsics;
  std::vector<Rigid3d> cams_from_world;
  std::vector<char> is_camera_fixed;    // as many as cameras
  std::vector<Eigen::Vector3d> points;  // in world
  std::vector<BundleObservation> observations;
};

// kAutomatic: kReduced with up to 100 free cameras, else kCeres.
enum class BundleSolverKind { kAutomatic, kCeres, kReduced };

struct BundleOptions {
  // Both find the same minimum; see ceres_bundle_solver.h and reduced_bundle_solver.h.
  BundleSolverKind solver = BundleSolverKind::kAutomatic;
  int robust_iterations = 5;  // most iterations of the first round, with a Huber loss
  int plain_iterations = 10;  // most iterations of the second, of the inliers alone, without it
  // Squared weighted error above which an observation is an outlier; its root is Huber's width.
  double max_squared_error = kChiSquare95With2Dof;
  // A round ends when a step changes the cost by a smaller share of it.
  double function_tolerance = 1e-3;
  int num_threads = 1;      // of kCeres; more than 1 may change the last bits from run to run
  double max_time_s = 0.0;  // of the whole call, looked at between iterations; 0: no limit

  void Visit(OptionVisitor& visitor) {
    visitor.Field("robust_iterations", robust_iterations, "most iterations of the robust round");
    visitor.Field("plain_iterations", plain_iterations, "most iterations of the round of inliers");
    visitor.Field("max_squared_error", max_squared_error,
                  "squared error over variance of an outlier; chi-square, 2 dof, 95 %");
    visitor.Field("function_tolerance", function_tolerance,
                  "relative change of the cost that ends a round");
    visitor.Field("num_threads", num_threads, "threads of the solver; 1: repeatable to the bit");
    visitor.Field("max_time_s", max_time_s, "time limit; makes results depend on speed; 0: none");
  }
};

struct BundleReport {
  // One an observation, under the final poses and points: in front and within max_squared_error.
  std::vector<char> is_inlier;
  double initial_cost = 0.0;  // 1/2 sum of Huber losses over all observations in front of a camera
  double final_cost = 0.0;  // 1/2 sum of squared weighted errors of the second round's observations
  int iterations = 0;       // of both rounds, failed steps included
  bool usable = false;
  std::string message;  // why it ended, or why it is not usable
};

// Bundle adjustment: moves points and free cameras to the least squared weighted reprojection
// errors. A robust round over all observations in front of their cameras, then one over its
// inliers without a robust loss.
// Result in `problem`; when the report is not usable, `problem` is unchanged and is_inlier speaks
// of the input. The caller fixes the gauge: at least one fixed camera, two to hold the scale;
// without them the damping of the solver keeps the map near where it was.
// Same input, same bits, with one thread (kReduced always uses one).
BundleReport SolveBundle(BundleProblem& problem, const BundleOptions& options = {});

}  // namespace lift_slam
