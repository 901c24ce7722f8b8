#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "lift_slam/features/descriptors.h"
#include "lift_slam/image/patch_alignment.h"
#include "lift_slam/map/ids.h"

namespace lift_slam {

// A 3-D point and the keyframe features that see it.
struct MapPoint {
  struct Observation {
    KeyFrameId keyframe;
    int feature = -1;  // index into the keyframe's features
    // Undistorted pixel: as detected, or where alignment to the point's patch found it.
    Eigen::Vector2f pixel = Eigen::Vector2f::Zero();
    bool is_aligned = false;
  };
  // The patch that all observations of the point are aligned to, and the view it was cut from.
  struct Anchor {
    KeyFrameId keyframe;
    Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  // undistorted, of the patch's centre
    // Undistorted pixels per pixel of the patch: the feature's scale, and the lens there.
    Eigen::Matrix2f undistorted_from_patch = Eigen::Matrix2f::Identity();
    ReferencePatch patch;
  };

  MapPointId id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world, map units
  std::vector<Observation> observations;               // sorted by keyframe id
  KeyFrameId created_by;  // the newest keyframe when the point was made

  // Appearance, kept up to date by UpdateAppearance.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // mean viewing direction, unit
  double min_distance = 0.0, max_distance = 0.0;     // where its level is within the pyramid
  std::vector<std::byte> descriptor;                 // the observation nearest to all others

  std::optional<Anchor> anchor;  // nothing: made without an image

  // Counted over tracked frames: how often it should have been seen and how often it was.
  int num_visible = 1;
  int num_found = 1;

  int num_observations() const { return static_cast<int>(observations.size()); }
  // Feature of the keyframe that sees this point; -1: none.
  int FeatureIn(KeyFrameId keyframe) const;
};

}  // namespace lift_slam
