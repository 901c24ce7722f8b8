#include "lift_slam/optimization/map_bundle.h"

#include "lift_slam/optimization/map_bundle_problem.h"

namespace lift_slam {
namespace {

// Takes the result over into the map; returns the number of observations removed.
int WriteBack(const BundleIndex& index, const BundleProblem& problem, const BundleReport& report,
              Map& map) {
  WritePosesAndPoints(index, problem, map);
  const int outliers = RemoveOutliers(index, problem, report.is_inlier, map);
  for (const MapPointId id : index.points) {
    if (map.FindPoint(id) != nullptr) map.UpdateViewingRange(id);
  }
  return outliers;
}

MapBundleReport Adjust(const BundleIndex& index, BundleProblem& problem,
                       const BundleOptions& options, Map& map) {
  MapBundleReport report;
  report.solver = SolveBundle(problem, options);
  report.points = static_cast<int>(problem.points.size());
  report.observations = static_cast<int>(problem.observations.size());
  if (report.solver.usable) report.outliers = WriteBack(index, problem, report.solver, map);
  return report;
}

}  // namespace

MapBundleReport AdjustBundle(const std::vector<KeyFrameId>& free_keyframes,
                             const std::vector<KeyFrameId>& fixed_keyframes,
                             const BundleOptions& options, Map& map) {
  BundleIndex index;
  BundleProblem problem = MakeBundleProblem(free_keyframes, fixed_keyframes, map, index);
  MapBundleReport report = Adjust(index, problem, options, map);
  report.free_keyframes = static_cast<int>(free_keyframes.size());
  report.fixed_keyframes = static_cast<int>(fixed_keyframes.size());
  return report;
}

MapBundleReport AdjustWholeMap(const BundleOptions& options,
                               const CalibrationCorrection& correction, Map& map) {
  BundleIndex index;
  BundleProblem problem = MakeBundleProblem(map.KeyFrameIds(), {}, map, index);
  if (!correction.IsIdentity()) MakePixelsIdeal(correction, problem);
  MapBundleReport report = Adjust(index, problem, options, map);
  report.free_keyframes = map.num_keyframes();
  return report;
}

}  // namespace lift_slam
