#pragma once

#include <string>
#include <vector>

#include "lift_slam/geometry/alignment.h"
#include "lift_slam/geometry/sim3.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// A measured similarity between two cameras.
struct PoseGraphEdge {
  int a = 0, b = 0;  // indices into cams_from_world, different
  Sim3d b_from_a;
  double weight = 1.0;  // of its residuals
};

// Cameras as similarities: a camera's scale is that of its own units to the world's, x_in_cam =
// scale R x_in_world + t. A keyframe before loop correction has scale 1.
struct PoseGraph {
  std::vector<Sim3d> cams_from_world;
  std::vector<char> is_fixed;  // as many; at least one
  std::vector<PoseGraphEdge> edges;
};

struct PoseGraphOptions {
  int max_iterations = 50;
  double function_tolerance = 1e-6;  // ends when a step changes the cost by a smaller share of it
  // Translations count relative to this many map units; 0: the median length of the edges, so that
  // the map's scale has no influence.
  double translation_unit_map_units = 0.0;
  int num_threads = 1;  // more than 1 may change the last bits from run to run

  void Visit(OptionVisitor& visitor) {
    visitor.Field("max_iterations", max_iterations, "most iterations");
    visitor.Field("function_tolerance", function_tolerance,
                  "relative change of the cost that ends the optimisation");
    visitor.Field("translation_unit_map_units", translation_unit_map_units,
                  "length that counts as one radian; 0: the median edge");
    visitor.Field("num_threads", num_threads, "threads; 1: repeatable to the bit");
  }
};

struct PoseGraphReport {
  double initial_cost = 0.0, final_cost = 0.0;  // half the sum of squared residuals
  int iterations = 0;
  bool usable = false;
  std::string message;  // why it ended, or why it is not usable
};

// Essential graph optimisation (ORB-SLAM sec. VII-D; Strasdat et al., 2010): moves the free cameras
// so that the measured similarities between cameras fit best; residuals in
// cost_functions/pose_graph_cost.h. kFixed keeps all scales. Cameras without a path of edges to a
// fixed one stay about where they are. The result is in `graph`; when the report is not usable,
// `graph` is unchanged. 1500 cameras with 8000 edges take a second or two. Same input, same bits
// (one thread).
PoseGraphReport SolvePoseGraph(PoseGraph& graph, ScaleFit scale_fit,
                               const PoseGraphOptions& options = {});

// A camera of the optimised graph as a rigid pose, and what moves its points along: the camera with
// scale 1 in the corrected world has the translation divided by its scale (ORB-SLAM sec. VII-D).
Rigid3d CorrectedPose(const Sim3d& cam_from_world);
// The point that lies for the corrected camera where it lay for the camera before the correction.
Eigen::Vector3d CorrectedPoint(const Eigen::Vector3d& point_in_old_world,
                               const Rigid3d& cam_from_old_world,
                               const Sim3d& cam_from_corrected_world);

}  // namespace lift_slam
