#include "lift_slam/optimization/reduced_bundle_solver.h"

#include <ceres/tiny_solver.h>

#include <algorithm>
#include <numeric>
#include <tuple>

namespace lift_slam {
namespace {

using TinySolver = ceres::TinySolver<ReducedBundleCost, Eigen::LLT<Eigen::MatrixXd>>;

std::string Message(const TinySolver::Summary& summary) {
  switch (summary.status) {
    case TinySolver::GRADIENT_TOO_SMALL:
      return "gradient tolerance reached";
    case TinySolver::RELATIVE_STEP_SIZE_TOO_SMALL:
      return "parameter tolerance reached";
    case TinySolver::COST_TOO_SMALL:
      return "cost is zero";
    case TinySolver::COST_CHANGE_TOO_SMALL:
      return "function tolerance reached";
    case TinySolver::HIT_MAX_ITERATIONS:
      return "maximum number of iterations or time reached";
  }
  return "unknown";
}

}  // namespace

ReducedBundleSolver::ReducedBundleSolver(const BundleProblem& problem)
    : problem_(problem), points_(problem.points), order_(problem.observations.size()) {
  for (std::size_t i = 0; i < problem.cams_from_world.size(); ++i) {
    cameras_.emplace_back(problem.cams_from_world[i]);
    const bool is_fixed = problem.is_camera_fixed[i] != 0;
    free_index_.push_back(is_fixed ? -1 : static_cast<int>(free_cameras_.size()));
    if (!is_fixed) free_cameras_.push_back(static_cast<int>(i));
  }
  std::iota(order_.begin(), order_.end(), 0);
  const auto key = [&](int i) {
    const BundleObservation& observation = problem.observations[static_cast<std::size_t>(i)];
    return std::tuple(observation.point, free_index_[static_cast<std::size_t>(observation.camera)],
                      i);
  };
  std::sort(order_.begin(), order_.end(), [&](int a, int b) { return key(a) < key(b); });
}

void ReducedBundleSolver::GatherObservations(const std::vector<char>& is_active) {
  observations_.clear();
  ranges_.clear();
  for (const int i : order_) {
    if (!is_active[static_cast<std::size_t>(i)]) continue;
    const BundleObservation& observation = problem_.observations[static_cast<std::size_t>(i)];
    const int position = static_cast<int>(observations_.size());
    if (ranges_.empty() || ranges_.back().point != observation.point) {
      ranges_.push_back({observation.point, position, position});
    }
    observations_.push_back(
        {observation.camera, free_index_[static_cast<std::size_t>(observation.camera)],
         observation.pixel.x(), observation.pixel.y(), observation.inverse_variance});
    ranges_.back().end = position + 1;
  }
}

BundleRoundSummary ReducedBundleSolver::Solve(const std::vector<char>& is_active,
                                              const BundleRoundOptions& options) {
  GatherObservations(is_active);
  const ReducedBundleCost cost({problem_.intrinsics, options.huber_width, options.max_time_s},
                               cameras_, free_cameras_, observations_, ranges_, points_);
  Eigen::VectorXd parameters(cost.NumParameters());
  for (std::size_t i = 0; i < free_cameras_.size(); ++i) {
    parameters.segment<6>(6 * static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::Matrix<double, 6, 1>>(
            cameras_[static_cast<std::size_t>(free_cameras_[i])].parameters());
  }
  const double initial_squared_norm = cost.Linearize().squared_norm;
  TinySolver solver;
  solver.options.max_num_iterations = options.max_iterations + 1;  // it counts from 1
  solver.options.function_tolerance = options.function_tolerance * initial_squared_norm;
  solver.options.gradient_tolerance = 0.0;  // the points have gradients of their own
  const TinySolver::Summary& summary = solver.Solve(cost, &parameters);
  cost.Accept(parameters);
  return {summary.initial_cost, summary.final_cost,
          std::min(summary.iterations, options.max_iterations), true, Message(summary)};
}

}  // namespace lift_slam
