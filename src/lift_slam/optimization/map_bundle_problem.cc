#include "lift_slam/optimization/map_bundle_problem.h"

namespace lift_slam {
namespace {

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

}  // namespace

BundleProblem MakeBundleProblem(const std::vector<KeyFrameId>& free_keyframes,
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

void DropUndeterminedPoints(BundleIndex& index, BundleProblem& problem) {
  std::vector<int> times_seen(problem.points.size(), 0), new_index(problem.points.size(), -1);
  for (const auto& observation : problem.observations) {
    ++times_seen[static_cast<std::size_t>(observation.point)];
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    if (times_seen[i] < 2) continue;
    new_index[i] = static_cast<int>(kept);
    problem.points[kept] = problem.points[i];
    index.points[kept++] = index.points[i];
  }
  problem.points.resize(kept);
  index.points.resize(kept);
  for (auto& observation : problem.observations) {
    observation.point = new_index[static_cast<std::size_t>(observation.point)];
  }
  std::erase_if(problem.observations,
                [](const auto& observation) { return observation.point < 0; });
}

void WritePosesAndPoints(const BundleIndex& index, const BundleProblem& problem, Map& map) {
  for (std::size_t i = 0; i < index.keyframes.size(); ++i) {
    if (!problem.is_camera_fixed[i]) map.SetPose(index.keyframes[i], problem.cams_from_world[i]);
  }
  for (std::size_t i = 0; i < index.points.size(); ++i) {
    map.point(index.points[i]).position = problem.points[i];
  }
}

int RemoveOutliers(const BundleIndex& index, const BundleProblem& problem,
                   const std::vector<char>& is_inlier, Map& map) {
  int removed = 0;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    if (is_inlier[i]) continue;
    const BundleObservation& observation = problem.observations[i];
    const MapPointId point = index.points[static_cast<std::size_t>(observation.point)];
    const KeyFrameId keyframe = index.keyframes[static_cast<std::size_t>(observation.camera)];
    if (map.FindPoint(point) == nullptr || map.point(point).FeatureIn(keyframe) < 0) continue;
    map.RemoveObservation(point, keyframe);
    ++removed;
  }
  return removed;
}

}  // namespace lift_slam
