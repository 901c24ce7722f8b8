#include "lift_slam/optimization/map_bundle.h"

#include <algorithm>

namespace lift_slam {
namespace {

// Ids to indices of the bundle problem and back, in ascending order of id.
struct BundleIndex {
  std::vector<KeyFrameId> keyframes;
  std::vector<MapPointId> points;
  std::vector<int> camera_of_keyframe;  // by keyframe id; -1: not in the problem

  int CameraOf(KeyFrameId id) const {
    return id.index() < camera_of_keyframe.size() ? camera_of_keyframe[id.index()] : -1;
  }
};

void AddCameras(const std::vector<KeyFrameId>& ids, bool is_fixed, const Map& map,
                BundleIndex& index, BundleProblem& problem) {
  for (const KeyFrameId id : ids) {
    if (index.camera_of_keyframe.size() <= id.index()) {
      index.camera_of_keyframe.resize(id.index() + 1, -1);
    }
    index.camera_of_keyframe[id.index()] = static_cast<int>(index.keyframes.size());
    index.keyframes.push_back(id);
    problem.cams_from_world.push_back(map.keyframe(id).cam_from_world);
    problem.is_camera_fixed.push_back(is_fixed || id.value == 0);
  }
}

void AddPointsAndObservations(const Map& map, BundleIndex& index, BundleProblem& problem) {
  for (const MapPointId id : index.points) {
    const int point_index = static_cast<int>(problem.points.size());
    const MapPoint& point = map.point(id);
    problem.points.push_back(point.position);
    for (const auto& observation : point.observations) {
      const int camera = index.CameraOf(observation.keyframe);
      if (camera < 0) continue;
      const FrameFeatures& features = *map.keyframe(observation.keyframe).features;
      problem.observations.push_back(
          {camera, point_index, observation.pixel.cast<double>(),
           map.view().InverseVariance(features.level(observation.feature),
                                      observation.is_aligned)});
    }
  }
}

BundleProblem MakeProblem(const std::vector<KeyFrameId>& free_keyframes,
                          const std::vector<KeyFrameId>& fixed_keyframes, const Map& map,
                          BundleIndex& index) {
  BundleProblem problem;
  problem.intrinsics = map.view().pinhole;
  AddCameras(free_keyframes, /*is_fixed=*/false, map, index, problem);
  AddCameras(fixed_keyframes, /*is_fixed=*/true, map, index, problem);
  index.points = map.PointsSeenBy(free_keyframes);
  AddPointsAndObservations(map, index, problem);
  return problem;
}

void WritePosesAndPoints(const BundleIndex& index, const BundleProblem& problem, Map& map) {
  for (std::size_t i = 0; i < index.keyframes.size(); ++i) {
    if (!problem.is_camera_fixed[i]) map.SetPose(index.keyframes[i], problem.cams_from_world[i]);
  }
  for (std::size_t i = 0; i < index.points.size(); ++i) {
    map.point(index.points[i]).position = problem.points[i];
  }
}

// Takes the result over into the map; returns the number of observations removed.
int WriteBack(const BundleIndex& index, const BundleProblem& problem, const BundleReport& report,
              Map& map) {
  WritePosesAndPoints(index, problem, map);
  int outliers = 0;
  for (std::size_t k = 0; k < problem.observations.size(); ++k) {
    if (report.is_inlier[k]) continue;
    ++outliers;
    const BundleObservation& observation = problem.observations[k];
    const MapPointId point = index.points[static_cast<std::size_t>(observation.point)];
    const KeyFrameId keyframe = index.keyframes[static_cast<std::size_t>(observation.camera)];
    if (map.FindPoint(point) != nullptr && map.point(point).FeatureIn(keyframe) >= 0) {
      map.RemoveObservation(point, keyframe);
    }
  }
  for (const MapPointId id : index.points) {
    if (map.FindPoint(id) != nullptr) map.UpdateViewingRange(id);
  }
  return outliers;
}

}  // namespace

MapBundleReport AdjustBundle(const std::vector<KeyFrameId>& free_keyframes,
                             const std::vector<KeyFrameId>& fixed_keyframes,
                             const BundleOptions& options, Map& map) {
  BundleIndex index;
  BundleProblem problem = MakeProblem(free_keyframes, fixed_keyframes, map, index);
  MapBundleReport report;
  report.solver = SolveBundle(problem, options);
  report.free_keyframes = static_cast<int>(free_keyframes.size());
  report.fixed_keyframes = static_cast<int>(fixed_keyframes.size());
  report.points = static_cast<int>(problem.points.size());
  report.observations = static_cast<int>(problem.observations.size());
  if (report.solver.usable) report.outliers = WriteBack(index, problem, report.solver, map);
  return report;
}

MapBundleReport AdjustWholeMap(const BundleOptions& options, Map& map) {
  return AdjustBundle(map.KeyFrameIds(), {}, options, map);
}

SelfCalibrationReport SelfCalibrateMap(const SelfCalibrationOptions& options, Map& map) {
  SelfCalibrationReport report;
  if (!options.enabled || map.num_keyframes() < options.min_keyframes) return report;
  BundleIndex index;
  BundleProblem problem = MakeProblem(map.KeyFrameIds(), {}, map, index);
  report = SelfCalibrate(problem, options);
  if (report.usable) WritePosesAndPoints(index, problem, map);
  return report;
}

}  // namespace lift_slam
