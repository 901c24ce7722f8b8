#include "lift_slam/optimization/sim3_optimization.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lift_slam/optimization/cost_functions/sim3_depth_cost.h"
#include "lift_slam/optimization/cost_functions/sim3_reprojection_cost.h"
#include "lift_slam/optimization/min_depth.h"

namespace lift_slam {
namespace {

using Direction = Sim3ReprojectionCost::Direction;
constexpr int kMinInliers = 3;
// Depths off by more sigmas than this hardly count: of two maps many are rough.
constexpr double kDepthLossSigmas = 2.0;

double SquaredError(const PinholeIntrinsics& intrinsics, const Eigen::Vector3d& x_in_cam,
                    const Eigen::Vector2d& pixel, double inverse_variance) {
  if (!(x_in_cam.z() > kMinDepth)) return std::numeric_limits<double>::infinity();
  return inverse_variance * (intrinsics.Project(x_in_cam) - pixel).squaredNorm();
}

class Sim3Optimizer {
 public:
  Sim3Optimizer(const PinholeIntrinsics& intrinsics1, const PinholeIntrinsics& intrinsics2,
                std::span<const Sim3Observation> observations, ScaleFit scale_fit,
                const Sim3OptimizationOptions& options)
      : intrinsics1_(intrinsics1),
        intrinsics2_(intrinsics2),
        observations_(observations),
        scale_fit_(scale_fit),
        options_(options) {}

  Sim3OptimizationResult Run(const Sim3d& initial) const {
    Sim3OptimizationResult result = Classify(initial, std::numeric_limits<double>::max());
    for (int round = 0; round <= options_.robust_rounds; ++round) {
      if (result.num_inliers < kMinInliers) return Classify(initial, options_.max_squared_error);
      const bool is_robust = round < options_.robust_rounds;
      result = Classify(Solve(result, is_robust), options_.max_squared_error);
    }
    if (result.num_inliers < kMinInliers) return Classify(initial, options_.max_squared_error);
    return result;
  }

 private:
  Sim3OptimizationResult Classify(const Sim3d& cam1_from_cam2, double limit) const {
    Sim3OptimizationResult result{cam1_from_cam2, {}, 0};
    const Sim3d cam2_from_cam1 = Inverse(cam1_from_cam2);
    for (const Sim3Observation& o : observations_) {
      const double error1 = SquaredError(intrinsics1_, cam1_from_cam2 * o.point_in_cam2, o.pixel1,
                                         o.inverse_variance1);
      const double error2 = SquaredError(intrinsics2_, cam2_from_cam1 * o.point_in_cam1, o.pixel2,
                                         o.inverse_variance2);
      result.is_inlier.push_back(std::max(error1, error2) <= limit);
      result.num_inliers += result.is_inlier.back();
    }
    return result;
  }

  Sim3d Solve(const Sim3OptimizationResult& from, bool is_robust) const {
    std::array<double, kSim3Parameters> change{};
    ceres::Problem problem;
    problem.AddParameterBlock(change.data(), kSim3Parameters);
    if (scale_fit_ == ScaleFit::kFixed) {
      problem.SetManifold(change.data(),
                          new ceres::SubsetManifold(kSim3Parameters, {kLogScaleParameter}));
    }
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      if (from.is_inlier[i]) Add(observations_[i], from.cam1_from_cam2, is_robust, change, problem);
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = options_.iterations_per_round;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return ApplySim3Change(change.data(), from.cam1_from_cam2);
  }

  void Add(const Sim3Observation& o, const Sim3d& base, bool is_robust,
           std::array<double, kSim3Parameters>& change, ceres::Problem& problem) const {
    const auto loss = [&]() -> ceres::LossFunction* {
      return is_robust ? new ceres::HuberLoss(std::sqrt(options_.max_squared_error)) : nullptr;
    };
    const Sim3ReprojectionCost in_image1(intrinsics1_, base, Direction::kForward, o.point_in_cam2,
                                         o.pixel1, std::sqrt(o.inverse_variance1));
    const Sim3ReprojectionCost in_image2(intrinsics2_, base, Direction::kBackward, o.point_in_cam1,
                                         o.pixel2, std::sqrt(o.inverse_variance2));
    problem.AddResidualBlock(Sim3ReprojectionCost::Create(in_image1), loss(), change.data());
    problem.AddResidualBlock(Sim3ReprojectionCost::Create(in_image2), loss(), change.data());
    if (scale_fit_ == ScaleFit::kFixed || !(o.log_depth_sigma > 0.0)) return;
    if (!(o.point_in_cam1.z() > kMinDepth)) return;
    const Sim3DepthCost depth(base, o.point_in_cam2, std::log(o.point_in_cam1.z()),
                              1.0 / o.log_depth_sigma);
    problem.AddResidualBlock(Sim3DepthCost::Create(depth), new ceres::CauchyLoss(kDepthLossSigmas),
                             change.data());
  }

  const PinholeIntrinsics& intrinsics1_;
  const PinholeIntrinsics& intrinsics2_;
  std::span<const Sim3Observation> observations_;
  ScaleFit scale_fit_;
  const Sim3OptimizationOptions& options_;
};

}  // namespace

Sim3OptimizationResult OptimizeSim3(const PinholeIntrinsics& intrinsics1,
                                    const PinholeIntrinsics& intrinsics2,
                                    const Sim3d& initial_cam1_from_cam2,
                                    std::span<const Sim3Observation> observations,
                                    ScaleFit scale_fit, const Sim3OptimizationOptions& options) {
  return Sim3Optimizer(intrinsics1, intrinsics2, observations, scale_fit, options)
      .Run(initial_cam1_from_cam2);
}

}  // namespace lift_slam
