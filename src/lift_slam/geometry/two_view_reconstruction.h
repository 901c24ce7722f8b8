#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Monocular initialisation: relative pose and points from matches between two images.
//
// A homography, a pure rotation and essential matrices are estimated side by side. The poses of
// the homography and of the best essential matrices are refined and scored alike (Sampson error
// and depth signs of all matches); the result is the best one, provided that a rotation alone does
// not explain the matches, that enough points have parallax, and that no other pose does as well.
// The idea of two competing models is that of ORB-SLAM (Mur-Artal et al. 2015, sec. IV).

struct TwoViewMatch {
  Eigen::Vector2d normalized1 = Eigen::Vector2d::Zero();  // x / z, y / z in image 1, undistorted
  Eigen::Vector2d normalized2 = Eigen::Vector2d::Zero();  // the same point in image 2
  double sigma_px = 1.0;  // standard deviation of each coordinate (larger on coarse levels)
};

enum class TwoViewStatus {
  kSuccess,
  kTooFewMatches,    // fewer than min_matches
  kLowParallax,      // still camera, or too little motion for the depth of the scene
  kPureRotation,     // the camera turned, but did not move enough
  kAmbiguousPlanar,  // two different poses explain the matches equally well
  kTooFewPoints,     // the best pose explains too few matches
};
std::string_view Name(TwoViewStatus status);  // "success", "low_parallax", ...

enum class TwoViewModelKind { kHomography, kEssential };

struct TwoViewOptions {
  int min_matches = 60;               // below, no model can be trusted
  double min_inlier_ratio = 0.4;      // of the matches; fewer: the pose is not that of the scene
  int min_points = 50;                // points with min_parallax_deg, to start a map with
  double min_point_ratio = 0.1;       // of the inliers; a small moving object is not the scene
  double min_parallax_deg = 0.8;      // about 10 px at 700 px focal length: depth to 10 percent
  double max_rotation_ratio = 0.85;   // matches that a rotation explains, of the pose's inliers
  double max_runner_up_ratio = 0.95;  // score of another pose against the best
  int max_iterations = 300;           // RANSAC samples for the essential matrix

  void Visit(OptionVisitor& visitor);
};

struct TwoViewReconstruction {
  TwoViewStatus status = TwoViewStatus::kTooFewMatches;
  // Which model the pose came from; a planar scene usually gives kHomography.
  TwoViewModelKind model = TwoViewModelKind::kEssential;
  // Translation norm 1. The best pose found even when the status refuses it (then for diagnosis
  // only); identity when there was none.
  Rigid3d cam2_from_cam1;
  std::vector<std::uint8_t> is_inlier;  // a match: 1 when it agrees with pose and depth sign
  // A match: its point in the frame of camera 1, when it is an inlier with at least
  // min_point_parallax (three times the noise) and its reprojection errors are small.
  std::vector<std::optional<Eigen::Vector3d>> points;
  std::vector<float> parallax_deg;  // a match: angle between its rays; 0 for outliers

  // For diagnosis.
  double median_parallax_deg = 0.0;  // of the inliers
  int num_inliers = 0;
  int num_points_with_parallax = 0;  // points with at least min_parallax_deg
  int num_homography_inliers = 0;
  int num_rotation_inliers = 0;
  int num_still_matches = 0;     // have not moved between the images
  double rotation_deg = 0.0;     // angle of the best pure rotation
  double noise_scale = 1.0;      // real noise against the given sigmas, in [0.25, 1]
  double score = 0.0;            // of the best pose
  double runner_up_score = 0.0;  // of the best pose that differs from it
};

// Deterministic for a seed. `focal_length_px` turns sigma_px into normalised units (use the mean
// of fx and fy). A few milliseconds for 500 matches.
TwoViewReconstruction ReconstructTwoViews(std::span<const TwoViewMatch> matches,
                                          double focal_length_px, const TwoViewOptions& options,
                                          std::uint64_t seed);

}  // namespace lift_slam
