#include "lift_slam/optimization/self_calibration.h"

#include <ceres/ceres.h>

#include <array>
#include <cmath>

#include "lift_slam/geometry/chi_square.h"
#include "lift_slam/optimization/min_depth.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// Parameter blocks: rotation cam_from_world (quaternion x y z w), translation (3), point in world
// (3), correction (focal scale, k1). Residual: (measured - predicted pixel) / sigma.
class CorrectedReprojection {
 public:
  CorrectedReprojection(const PinholeIntrinsics& intrinsics, const BundleObservation& observation)
      : intrinsics_(intrinsics), observation_(observation) {}

  static ceres::CostFunction* Create(const PinholeIntrinsics& intrinsics,
                                     const BundleObservation& observation) {
    return new ceres::AutoDiffCostFunction<CorrectedReprojection, 2, 4, 3, 3, 2>(
        new CorrectedReprojection(intrinsics, observation));
  }

  template <class T>
  bool operator()(const T* rotation, const T* translation, const T* point, const T* correction,
                  T* residual) const {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    const Vector3 in_cam =
        Eigen::Map<const Eigen::Quaternion<T>>(rotation) * Eigen::Map<const Vector3>(point) +
        Eigen::Map<const Vector3>(translation);
    if (!(in_cam.z() > T(kMinDepth))) return false;
    const T x = in_cam.x() / in_cam.z(), y = in_cam.y() / in_cam.z();
    const T scale = correction[0] * (T(1.0) + correction[1] * (x * x + y * y));
    const double weight = std::sqrt(observation_.inverse_variance);
    residual[0] = weight * (intrinsics_.fx * scale * x + intrinsics_.cx - observation_.pixel.x());
    residual[1] = weight * (intrinsics_.fy * scale * y + intrinsics_.cy - observation_.pixel.y());
    return true;
  }

 private:
  PinholeIntrinsics intrinsics_;
  BundleObservation observation_;
};

struct CorrectionPrior {
  double focal_scale_sigma, k1_sigma;

  template <class T>
  bool operator()(const T* correction, T* residual) const {
    residual[0] = (correction[0] - 1.0) / focal_scale_sigma;
    residual[1] = correction[1] / k1_sigma;
    return true;
  }
};

// The problem's values as Ceres' parameter blocks.
struct Parameters {
  explicit Parameters(const BundleProblem& problem)
      : cams_from_world(problem.cams_from_world), points(problem.points) {}

  std::vector<Rigid3d> cams_from_world;
  std::vector<Eigen::Vector3d> points;
  std::array<double, 2> correction = {1.0, 0.0};
};

void AddResiduals(const BundleProblem& problem, const SelfCalibrationOptions& options,
                  Parameters& parameters, ceres::Problem& solver) {
  for (const BundleObservation& observation : problem.observations) {
    Rigid3d& pose = parameters.cams_from_world[static_cast<std::size_t>(observation.camera)];
    Eigen::Vector3d& point = parameters.points[static_cast<std::size_t>(observation.point)];
    if (!((pose * point).z() > kMinDepth)) continue;
    solver.AddResidualBlock(CorrectedReprojection::Create(problem.intrinsics, observation),
                            new ceres::HuberLoss(std::sqrt(kChiSquare95With2Dof)),
                            pose.rotation.coeffs().data(), pose.translation.data(), point.data(),
                            parameters.correction.data());
  }
  solver.AddResidualBlock(new ceres::AutoDiffCostFunction<CorrectionPrior, 2, 2>(
                              new CorrectionPrior{options.focal_scale_sigma, options.k1_sigma}),
                          nullptr, parameters.correction.data());
}

// Quaternions stay unit; fixed cameras stay. Points are eliminated first.
void DescribeBlocks(const BundleProblem& problem, Parameters& parameters, ceres::Problem& solver,
                    ceres::ParameterBlockOrdering& ordering) {
  for (std::size_t i = 0; i < parameters.cams_from_world.size(); ++i) {
    Rigid3d& pose = parameters.cams_from_world[i];
    double* rotation = pose.rotation.coeffs().data();
    double* translation = pose.translation.data();
    if (!solver.HasParameterBlock(rotation)) continue;
    solver.SetManifold(rotation, new ceres::EigenQuaternionManifold);
    if (problem.is_camera_fixed[i]) {
      solver.SetParameterBlockConstant(rotation);
      solver.SetParameterBlockConstant(translation);
    }
    ordering.AddElementToGroup(rotation, 1);
    ordering.AddElementToGroup(translation, 1);
  }
  for (Eigen::Vector3d& point : parameters.points) {
    if (solver.HasParameterBlock(point.data())) ordering.AddElementToGroup(point.data(), 0);
  }
  ordering.AddElementToGroup(parameters.correction.data(), 1);
}

struct RefusalText {
  std::string_view name, explanation;
};

constexpr std::array<RefusalText, static_cast<std::size_t>(CalibrationRefusal::kCount)> kRefusals =
    {{
        {"none", "The given calibration was corrected."},
        {"not_reached", "The run did not come to it, or has not changed the map."},
        {"switched_off", "Self-calibration is switched off."},
        {"few_keyframes", "The map has too few keyframes to tell."},
        {"no_estimate", "No estimate was found that the map agrees with."},
        {"not_clearly_off", "What was found is within the error of such an estimate."},
    }};

const RefusalText& TextOf(CalibrationRefusal refusal) {
  const auto i = static_cast<std::size_t>(refusal);
  LIFT_SLAM_CHECK(i < kRefusals.size(), "refusal {}", i);
  return kRefusals[i];
}

}  // namespace

std::string_view Name(CalibrationRefusal refusal) { return TextOf(refusal).name; }

std::string_view Explain(CalibrationRefusal refusal) { return TextOf(refusal).explanation; }

Eigen::Vector2d CalibrationCorrection::ToIdeal(const PinholeIntrinsics& intrinsics,
                                               const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d measured = intrinsics.Unproject(pixel).head<2>() / focal_scale;
  // r (1 + k1 r^2) = |measured|: the correction is small, so this converges in a few steps.
  Eigen::Vector2d ideal = measured;
  for (int i = 0; i < 10; ++i) ideal = measured / (1.0 + k1 * ideal.squaredNorm());
  return {intrinsics.fx * ideal.x() + intrinsics.cx, intrinsics.fy * ideal.y() + intrinsics.cy};
}

bool IsClearlyOff(const CalibrationCorrection& correction, const SelfCalibrationOptions& options) {
  const Eigen::Vector2d off((correction.focal_scale - 1.0) / options.focal_scale_error,
                            correction.k1 / options.k1_error);
  return off.squaredNorm() > kChiSquare99With2Dof;
}

void MakePixelsIdeal(const CalibrationCorrection& correction, BundleProblem& problem) {
  for (BundleObservation& observation : problem.observations) {
    observation.pixel = correction.ToIdeal(problem.intrinsics, observation.pixel);
  }
}

SelfCalibrationReport SelfCalibrate(BundleProblem& problem, const SelfCalibrationOptions& options) {
  SelfCalibrationReport report{.refusal = CalibrationRefusal::kNoEstimate};
  if (problem.observations.empty()) return report;
  Parameters parameters(problem);
  ceres::Problem solver;
  AddResiduals(problem, options, parameters, solver);
  ceres::Solver::Options solver_options;
  solver_options.linear_solver_ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  DescribeBlocks(problem, parameters, solver, *solver_options.linear_solver_ordering);
  solver_options.linear_solver_type = ceres::SPARSE_SCHUR;
  solver_options.max_num_iterations = options.max_iterations;
  solver_options.function_tolerance = options.function_tolerance;
  solver_options.num_threads = 1;
  solver_options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver_options, &solver, &summary);
  report.initial_cost = summary.initial_cost;
  report.final_cost = summary.final_cost;
  report.iterations = static_cast<int>(summary.iterations.size());
  if (!summary.IsSolutionUsable() || parameters.correction[0] <= 0.5) return report;

  report.refusal = CalibrationRefusal::kNone;
  report.estimate = {parameters.correction[0], parameters.correction[1]};
  problem.cams_from_world = std::move(parameters.cams_from_world);
  problem.points = std::move(parameters.points);
  MakePixelsIdeal(report.estimate, problem);
  return report;
}

}  // namespace lift_slam
