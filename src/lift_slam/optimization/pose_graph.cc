#include "lift_slam/optimization/pose_graph.h"

#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <algorithm>
#include <array>

#include "lift_slam/optimization/cost_functions/pose_graph_cost.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/median.h"

namespace lift_slam {
namespace {

using Change = std::array<double, kSim3Parameters>;

void Check(const PoseGraph& graph) {
  const auto count = static_cast<int>(graph.cams_from_world.size());
  LIFT_SLAM_CHECK(graph.is_fixed.size() == graph.cams_from_world.size(), "{} cameras, {} flags",
                  count, graph.is_fixed.size());
  LIFT_SLAM_CHECK(std::count(graph.is_fixed.begin(), graph.is_fixed.end(), 0) < count,
                  "none of {} cameras is fixed", count);
  for (const PoseGraphEdge& edge : graph.edges) {
    LIFT_SLAM_CHECK(edge.a >= 0 && edge.a < count && edge.b >= 0 && edge.b < count &&
                        edge.a != edge.b && edge.b_from_a.scale > 0.0,
                    "edge from {} to {} of {} cameras, scale {}", edge.a, edge.b, count,
                    edge.b_from_a.scale);
  }
}

double TranslationUnit(const PoseGraph& graph, const PoseGraphOptions& options) {
  if (options.translation_unit_map_units > 0.0) return options.translation_unit_map_units;
  std::vector<double> lengths;
  for (const PoseGraphEdge& edge : graph.edges) {
    const double length = edge.b_from_a.translation.norm();
    if (length > 0.0) lengths.push_back(length);
  }
  return lengths.empty() ? 1.0 : Median(std::move(lengths));
}

class PoseGraphSolver {
 public:
  PoseGraphSolver(const PoseGraph& graph, ScaleFit scale_fit, const PoseGraphOptions& options)
      : graph_(graph), options_(options), changes_(graph.cams_from_world.size()) {
    AddEdges();
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      double* change = changes_[i].data();
      if (!problem_.HasParameterBlock(change)) continue;
      if (graph.is_fixed[i]) {
        problem_.SetParameterBlockConstant(change);
      } else if (scale_fit == ScaleFit::kFixed) {
        problem_.SetManifold(change,
                             new ceres::SubsetManifold(kSim3Parameters, {kLogScaleParameter}));
      }
    }
  }

  PoseGraphReport Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = options_.max_iterations;
    options.function_tolerance = options_.function_tolerance;
    options.num_threads = options_.num_threads;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return {summary.initial_cost, summary.final_cost,
            summary.num_successful_steps + summary.num_unsuccessful_steps,
            summary.IsSolutionUsable(), summary.message};
  }

  std::vector<Sim3d> CamsFromWorld() const {
    std::vector<Sim3d> cams_from_world;
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      cams_from_world.push_back(ApplySim3Change(changes_[i].data(), graph_.cams_from_world[i]));
    }
    return cams_from_world;
  }

 private:
  void AddEdges() {
    const double unit = TranslationUnit(graph_, options_);
    for (const PoseGraphEdge& edge : graph_.edges) {
      const auto a = static_cast<std::size_t>(edge.a), b = static_cast<std::size_t>(edge.b);
      const Sim3d base = graph_.cams_from_world[b] * Inverse(graph_.cams_from_world[a]);
      problem_.AddResidualBlock(
          PoseGraphCost::Create(PoseGraphCost(edge.b_from_a, base, edge.weight, unit)), nullptr,
          changes_[a].data(), changes_[b].data());
    }
  }

  const PoseGraph& graph_;
  const PoseGraphOptions& options_;
  std::vector<Change> changes_;
  ceres::Problem problem_;
};

}  // namespace

PoseGraphReport SolvePoseGraph(PoseGraph& graph, ScaleFit scale_fit,
                               const PoseGraphOptions& options) {
  Check(graph);
  PoseGraphSolver solver(graph, scale_fit, options);
  PoseGraphReport report = solver.Solve();
  if (report.usable) graph.cams_from_world = solver.CamsFromWorld();
  return report;
}

Rigid3d CorrectedPose(const Sim3d& cam_from_world) {
  return {cam_from_world.rotation, cam_from_world.translation / cam_from_world.scale};
}

Eigen::Vector3d CorrectedPoint(const Eigen::Vector3d& point_in_old_world,
                               const Rigid3d& cam_from_old_world,
                               const Sim3d& cam_from_corrected_world) {
  return Inverse(cam_from_corrected_world) * (cam_from_old_world * point_in_old_world);
}

}  // namespace lift_slam
