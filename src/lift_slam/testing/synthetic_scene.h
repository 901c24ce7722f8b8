#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lift_slam/camera/pinhole.h"
#include "lift_slam/geometry/rigid3.h"

namespace lift_slam {

// Points seen by cameras, with noise and outliers, all known. World frame like a camera's: x right,
// y down, z forward; units are metres.

enum class SyntheticShape {
  kVolume,  // points spread between min_depth and max_depth in front of the first camera
  kPlane,   // a tilted plane at the mean of both depths
};

struct SyntheticSceneOptions {
  SyntheticShape shape = SyntheticShape::kVolume;
  int num_points = 500;
  double min_depth = 4.0;  // metres from the first camera
  double max_depth = 20.0;
  double noise_px = 0.5;       // standard deviation of each pixel coordinate
  double outlier_ratio = 0.0;  // share of observations that are anywhere in the image
  std::uint64_t seed = 1;
};

struct SyntheticObservation {
  int point = -1;  // index into points
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  bool is_outlier = false;
};

struct SyntheticScene {
  PinholeIntrinsics pinhole;
  std::vector<Eigen::Vector3d> points;   // world
  std::vector<Rigid3d> cams_from_world;  // one a camera
  // A camera: what it sees, sorted by point; only points inside the image in front of it.
  std::vector<std::vector<SyntheticObservation>> observations;
};

// 640x480, 500 px focal length, centre in the middle.
PinholeIntrinsics SyntheticPinhole();

// Points lie in the view of a camera at the world's origin that looks along z.
SyntheticScene MakeSyntheticScene(const std::vector<Rigid3d>& cams_from_world,
                                  const SyntheticSceneOptions& options);

// Observations of one point in two cameras.
struct SyntheticMatch {
  int point = -1;
  Eigen::Vector2d pixel1, pixel2;
  bool is_outlier = false;  // in either camera
};
std::vector<SyntheticMatch> MatchesBetween(const SyntheticScene& scene, int camera1, int camera2);

}  // namespace lift_slam
