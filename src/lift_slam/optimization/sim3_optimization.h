#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/geometry/alignment.h"
#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/geometry/sim3.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// One place that two cameras see, each with a map point of its own in its own frame and units.
struct Sim3Observation {
  Eigen::Vector3d point_in_cam1, point_in_cam2;             // held fixed
  Eigen::Vector2d pixel1, pixel2;                           // undistorted
  double inverse_variance1 = 1.0, inverse_variance2 = 1.0;  // 1 / px^2, of x and of y
  // Standard deviation of log(depth in the second map / depth in the first), in camera 1; 0 or
  // infinite: the depths say nothing of the scale, nor where point_in_cam1 is not in front.
  double log_depth_sigma = 0.0;
};

struct Sim3OptimizationOptions {
  int robust_rounds = 2;          // with a Huber loss; inliers are chosen anew after each
  int iterations_per_round = 10;  // upper limit, also of the last round, which is plain
  // Squared weighted error in either image above which a match is an outlier, and its root Huber's
  // width. Wide: the map points, taken as exact, are not.
  double max_squared_error = kChiSquare99With2Dof;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("robust_rounds", robust_rounds, "rounds with a Huber loss, before a plain one");
    visitor.Field("iterations_per_round", iterations_per_round, "most iterations of a round");
    visitor.Field("max_squared_error", max_squared_error,
                  "squared error over variance of an outlier; chi-square, 2 dof, 99 %");
  }
};

struct Sim3OptimizationResult {
  Sim3d cam1_from_cam2;
  std::vector<char> is_inlier;  // one an observation: in front and within the limit in both images
  int num_inliers = 0;
};

// The similarity that minimises the squared weighted errors of both cameras' points, each in the
// other's image (ORB-SLAM sec. VII-B), and of both maps' depths, with a Cauchy loss. kFixed keeps
// the initial scale and leaves the depths out. With fewer than 3 inliers the similarity is
// undetermined: the result is the initial one with the inliers under it. Same input, same bits.
Sim3OptimizationResult OptimizeSim3(const PinholeIntrinsics& intrinsics1,
                                    const PinholeIntrinsics& intrinsics2,
                                    const Sim3d& initial_cam1_from_cam2,
                                    std::span<const Sim3Observation> observations,
                                    ScaleFit scale_fit = ScaleFit::kFree,
                                    const Sim3OptimizationOptions& options = {});

}  // namespace lift_slam
