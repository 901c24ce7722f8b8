#include "lift_slam/optimization/bundle_adjustment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lift_slam/optimization/bundle_round.h"
#include "lift_slam/optimization/ceres_bundle_solver.h"
#include "lift_slam/optimization/min_depth.h"
#include "lift_slam/optimization/reduced_bundle_solver.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

// With 80 free cameras kReduced takes a third of the time of kCeres; its time grows with the cube
// of their number, that of Ceres' sparse solver with their covisibility.
constexpr int kMaxReducedCameras = 100;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void CheckProblem(const BundleProblem& problem, const BundleOptions& options) {
  const std::size_t num_cameras = problem.cams_from_world.size();
  LIFT_SLAM_CHECK(problem.is_camera_fixed.size() == num_cameras, "{} flags for {} cameras",
                  problem.is_camera_fixed.size(), num_cameras);
  LIFT_SLAM_CHECK(options.robust_iterations >= 1 && options.plain_iterations >= 1,
                  "{} and {} iterations", options.robust_iterations, options.plain_iterations);
  LIFT_SLAM_CHECK(options.num_threads >= 1, "{} threads", options.num_threads);
  for (const BundleObservation& observation : problem.observations) {
    LIFT_SLAM_CHECK(
        observation.camera >= 0 && static_cast<std::size_t>(observation.camera) < num_cameras,
        "camera {} of {}", observation.camera, num_cameras);
    LIFT_SLAM_CHECK(observation.point >= 0 &&
                        static_cast<std::size_t>(observation.point) < problem.points.size(),
                    "point {} of {}", observation.point, problem.points.size());
    LIFT_SLAM_CHECK(observation.inverse_variance > 0.0, "inverse variance {}",
                    observation.inverse_variance);
  }
}

// Marks the observations in front of their cameras whose squared weighted error is within `limit`.
std::vector<char> Classify(const BundleProblem& problem, double limit) {
  std::vector<Eigen::Matrix3d> rotations;
  for (const Rigid3d& pose : problem.cams_from_world) rotations.push_back(pose.RotationMatrix());
  std::vector<char> is_inlier;
  is_inlier.reserve(problem.observations.size());
  for (const BundleObservation& observation : problem.observations) {
    const auto camera = static_cast<std::size_t>(observation.camera);
    const Eigen::Vector3d x_in_cam =
        rotations[camera] * problem.points[static_cast<std::size_t>(observation.point)] +
        problem.cams_from_world[camera].translation;
    const double error =
        x_in_cam.z() > kMinDepth
            ? observation.inverse_variance *
                  (problem.intrinsics.Project(x_in_cam) - observation.pixel).squaredNorm()
            : kInfinity;
    is_inlier.push_back(error <= limit);
  }
  return is_inlier;
}

template <class Solver>
void Store(const Solver& solver, BundleProblem& problem) {
  for (std::size_t i = 0; i < problem.cams_from_world.size(); ++i) {
    if (!problem.is_camera_fixed[i]) problem.cams_from_world[i] = solver.CamFromWorld(i);
  }
  problem.points = solver.points();
}

bool IsFinite(const BundleProblem& problem) {
  return std::all_of(problem.cams_from_world.begin(), problem.cams_from_world.end(),
                     [](const Rigid3d& pose) {
                       return pose.rotation.coeffs().allFinite() && pose.translation.allFinite();
                     }) &&
         std::all_of(problem.points.begin(), problem.points.end(),
                     [](const Eigen::Vector3d& point) { return point.allFinite(); });
}

bool HasAny(const std::vector<char>& flags) {
  return std::find(flags.begin(), flags.end(), char{1}) != flags.end();
}

// Both rounds of SolveBundle. Changes `problem` as it goes.
template <class Solver>
class BundleRounds {
 public:
  BundleRounds(BundleProblem& problem, const BundleOptions& options)
      : problem_(problem), options_(options), solver_(problem) {}

  BundleReport Solve() {
    const double width = std::sqrt(options_.max_squared_error);
    if (Run(std::numeric_limits<double>::max(), width, options_.robust_iterations)) {
      Run(options_.max_squared_error, kInfinity, options_.plain_iterations);
    }
    return std::move(report_);
  }

 private:
  // One round over the observations within `limit`; false when the result is not usable.
  bool Run(double limit, double huber_width, int max_iterations) {
    report_.usable = false;
    const std::vector<char> is_active = Classify(problem_, limit);
    if (!HasAny(is_active)) {
      report_.message = "no observation to adjust to";
      return false;
    }
    const BundleRoundSummary summary =
        solver_.Solve(is_active, {max_iterations, huber_width, options_.function_tolerance,
                                  options_.num_threads, TimeLeftS()});
    if (report_.iterations == 0) report_.initial_cost = summary.initial_cost;
    report_.final_cost = summary.final_cost;
    report_.iterations += summary.iterations;
    report_.message = summary.message;
    if (!summary.usable) return false;
    Store(solver_, problem_);
    report_.usable = IsFinite(problem_) && std::isfinite(summary.final_cost);
    if (!report_.usable) report_.message = "the solution is not finite";
    return report_.usable;
  }

  double TimeLeftS() const {
    if (options_.max_time_s <= 0.0) return kInfinity;
    return std::max(0.0, options_.max_time_s - 1e-3 * timer_.ElapsedMs());
  }

  BundleProblem& problem_;
  const BundleOptions& options_;
  Timer timer_;
  Solver solver_;
  BundleReport report_;
};

BundleSolverKind ChooseSolver(const BundleProblem& problem, BundleSolverKind wanted) {
  const auto& is_fixed = problem.is_camera_fixed;
  const auto num_free = std::count(is_fixed.begin(), is_fixed.end(), char{0});
  if (num_free == 0) return BundleSolverKind::kCeres;
  if (wanted != BundleSolverKind::kAutomatic) return wanted;
  return num_free <= kMaxReducedCameras ? BundleSolverKind::kReduced : BundleSolverKind::kCeres;
}

}  // namespace

BundleReport SolveBundle(BundleProblem& problem, const BundleOptions& options) {
  CheckProblem(problem, options);
  const std::vector<Rigid3d> initial_poses = problem.cams_from_world;
  const std::vector<Eigen::Vector3d> initial_points = problem.points;
  const bool is_reduced = ChooseSolver(problem, options.solver) == BundleSolverKind::kReduced;
  BundleReport report = is_reduced ? BundleRounds<ReducedBundleSolver>(problem, options).Solve()
                                   : BundleRounds<CeresBundleSolver>(problem, options).Solve();
  if (!report.usable) {
    problem.cams_from_world = initial_poses;
    problem.points = initial_points;
  }
  report.is_inlier = Classify(problem, options.max_squared_error);
  return report;
}

}  // namespace lift_slam
