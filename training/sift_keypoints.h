#pragma once

#include <vector>

#include "lift_slam/image/image.h"
#include "lift_slam/util/random.h"
#include "training/training_set.h"

namespace lift_slam::training {

// OpenCV's SIFT keypoints of at least `min_sigma`, the strongest `max_count` (0: all), strongest
// first; one for each place and scale (SIFT repeats those with two directions). `image` of the
// views is 0.
std::vector<View> DetectSift(const GrayImage& image, double min_sigma, int max_count);

// Random places whose squares of +-6 sigmas lie in the image and overlap (intersection over union)
// with none of the keypoints' by more than 0.1: the fourth patch of LIFT's quadruples. Sigmas are
// those of random keypoints. Fewer than `count` where 100 tries each do not find more.
std::vector<View> EmptyPlaces(const GrayImage& image, const std::vector<View>& keypoints, int count,
                              Random& random);

// Finds keypoints near a place.
class KeypointGrid {
 public:
  KeypointGrid(const std::vector<View>& keypoints, int width, int height);
  // The nearest keypoint within max(1.5 pixels, 0.3 sigma) and a factor 1.5 of the sigma.
  const View* Find(double x, double y, double sigma) const;

 private:
  static constexpr int kCellPx = 16;
  const std::vector<View>& keypoints_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

}  // namespace lift_slam::training
