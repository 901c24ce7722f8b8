#pragma once

#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/optimization/bundle_adjustment.h"

namespace lift_slam {

// Ids to indices of the bundle problem and back, in ascending order of id.
struct BundleIndex {
  std::vector<KeyFrameId> keyframes;
  std::vector<MapPointId> points;
  std::vector<int> camera_of_keyframe;  // by keyframe id; -1: not in the problem

  int CameraOf(KeyFrameId id) const {
    return id.index() < camera_of_keyframe.size() ? camera_of_keyframe[id.index()] : -1;
  }
};

// Free and fixed keyframes of a map, all points that the free ones see, and their observations in
// all of them. The map's first keyframe is fixed even when it is listed as free.
BundleProblem MakeBundleProblem(const std::vector<KeyFrameId>& free_keyframes,
                                const std::vector<KeyFrameId>& fixed_keyframes, const Map& map,
                                BundleIndex& index);

// Without points that fewer than two of the problem's cameras see: they say nothing.
void DropUndeterminedPoints(BundleIndex& index, BundleProblem& problem);

// The problem's free poses and its points become the map's.
void WritePosesAndPoints(const BundleIndex& index, const BundleProblem& problem, Map& map);

// Takes the observations that are no inliers (one entry for each of the problem's) out of the map,
// as far as they are still in it; returns how many.
int RemoveOutliers(const BundleIndex& index, const BundleProblem& problem,
                   const std::vector<char>& is_inlier, Map& map);

}  // namespace lift_slam
