#include "lift_slam/optimization/ceres_bundle_solver.h"

#include <ceres/loss_function.h>
#include <ceres/solver.h>

#include <cmath>
#include <optional>

namespace lift_slam {
namespace {

// From this many free cameras on the reduced camera system is taken as sparse.
constexpr int kMinCamerasForSparse = 60;

std::string Message(const ceres::Solver::Summary& summary) {
  return summary.message.empty() ? ceres::TerminationTypeToString(summary.termination_type)
                                 : summary.message;
}

}  // namespace

// Huber's loss whose width changes between rounds, so that the ceres::Problem need not.
class CeresBundleSolver::Loss final : public ceres::LossFunction {
 public:
  void SetWidth(double width) {
    huber_.reset();
    if (std::isfinite(width)) huber_.emplace(width);
  }
  void Evaluate(double squared_norm, double rho[3]) const override {
    if (huber_) return huber_->Evaluate(squared_norm, rho);
    rho[0] = squared_norm;
    rho[1] = 1.0;
    rho[2] = 0.0;
  }

 private:
  std::optional<ceres::HuberLoss> huber_;
};

CeresBundleSolver::CeresBundleSolver(const BundleProblem& problem)
    : points_(problem.points),
      loss_(std::make_unique<Loss>()),
      ordering_(std::make_shared<ceres::ParameterBlockOrdering>()) {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  options.evaluation_callback = this;
  ceres_problem_ = std::make_unique<ceres::Problem>(options);
  cameras_.reserve(problem.cams_from_world.size());
  for (const Rigid3d& pose : problem.cams_from_world) cameras_.emplace_back(pose);
  // Reserved: cost functions keep references to the terms.
  terms_.reserve(problem.observations.size());
  costs_.reserve(problem.observations.size());
  for (const BundleObservation& observation : problem.observations) {
    terms_.push_back(
        {problem.intrinsics, observation.pixel, std::sqrt(observation.inverse_variance)});
    AddObservation(observation,
                   problem.is_camera_fixed[static_cast<std::size_t>(observation.camera)] != 0);
  }
}

CeresBundleSolver::~CeresBundleSolver() = default;

void CeresBundleSolver::AddObservation(const BundleObservation& observation, bool is_camera_fixed) {
  CameraBlock& camera = cameras_[static_cast<std::size_t>(observation.camera)];
  double* point = points_[static_cast<std::size_t>(observation.point)].data();
  ordering_->AddElementToGroup(point, 0);
  if (is_camera_fixed) {
    costs_.emplace_back(FixedCameraReprojectionCost::Create(terms_.back(), camera));
    ceres_problem_->AddResidualBlock(costs_.back().get(), loss_.get(), point);
  } else {
    ordering_->AddElementToGroup(camera.parameters(), 1);
    costs_.emplace_back(ReprojectionCost::Create(terms_.back(), camera));
    ceres_problem_->AddResidualBlock(costs_.back().get(), loss_.get(), point, camera.parameters());
  }
}

BundleRoundSummary CeresBundleSolver::Solve(const std::vector<char>& is_active,
                                            const BundleRoundOptions& options) {
  for (std::size_t i = 0; i < terms_.size(); ++i) terms_[i].is_active = is_active[i] != 0;
  loss_->SetWidth(options.huber_width);
  ceres::Solver::Options solver_options;
  solver_options.linear_solver_type =
      ordering_->GroupSize(1) < kMinCamerasForSparse ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR;
  solver_options.linear_solver_ordering = ordering_;
  solver_options.max_num_iterations = options.max_iterations;
  solver_options.function_tolerance = options.function_tolerance;
  solver_options.num_threads = options.num_threads;
  if (std::isfinite(options.max_time_s)) {
    solver_options.max_solver_time_in_seconds = options.max_time_s;
  }
  solver_options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options, ceres_problem_.get(), &summary);
  for (CameraBlock& camera : cameras_) camera.Update();
  return {summary.initial_cost, summary.final_cost,
          summary.num_successful_steps + summary.num_unsuccessful_steps, summary.IsSolutionUsable(),
          Message(summary)};
}

void CeresBundleSolver::PrepareForEvaluation(bool /*evaluate_jacobians*/,
                                             bool new_evaluation_point) {
  if (!new_evaluation_point) return;
  for (CameraBlock& camera : cameras_) camera.Update();
}

}  // namespace lift_slam
