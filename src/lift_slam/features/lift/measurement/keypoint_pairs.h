#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/features/lift/peak_refinement.h"
#include "lift_slam/image/image.h"
#include "lift_slam/util/random.h"

namespace lift_slam {

// Keypoints of two images that show the same places, without any use of the descriptors that are
// to be measured: in_a[i] and in_b[i]. All their squares of 6 sigma lie within the images.
struct KeypointPairs {
  GrayImage image_a, image_b;
  std::vector<LiftKeypoint> in_a, in_b;
};

using KeypointFinder = std::function<std::vector<LiftKeypoint>(const GrayImage&)>;

// SIFT's keypoints of sigma 1.5 and more, one at a place, strongest first.
std::vector<LiftKeypoint> FindBlobs(const GrayImage& image);

// How much a copy of an image differs from it; each uniform, scale and gamma in their logarithms.
struct WarpOptions {
  double max_rotation_deg = 8.0;
  double max_scale = 1.25;        // and its inverse
  double max_perspective = 0.15;  // change of scale from the image's centre to its border
  double max_gamma = 1.5;         // and its inverse
  double noise_sigma_grey = 2.0;  // of each pixel
};

// A homography about the middle of the image: warped_from_image.
Eigen::Matrix3d RandomWarp(const GrayImage& image, const WarpOptions& options, Random& random);

// The warped image with changed gamma and with noise.
GrayImage WarpedCopy(const GrayImage& image, const Eigen::Matrix3d& warped_from_image,
                     const WarpOptions& options, Random& random);

// Where a keypoint comes to lie, and its sigma there.
LiftKeypoint Warped(const LiftKeypoint& keypoint, const Eigen::Matrix3d& warped_from_image);

// Keypoints found in the image and in a warped copy at the same place (to half a sigma) and of the
// same size (to a factor of 1.25); the strongest max_pairs.
KeypointPairs PairsByWarp(const GrayImage& image, const KeypointFinder& find, int max_pairs,
                          const WarpOptions& options, Random& random);

// SIFT's matches of two photographs that fulfil the epipolar geometry (with a camera: of its
// undistorted pixels); at most max_pairs, of all descriptor distances.
KeypointPairs PairsBySift(const GrayImage& image_a, const GrayImage& image_b, const Camera* camera,
                          int max_pairs);

}  // namespace lift_slam
