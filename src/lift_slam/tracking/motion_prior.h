#pragma once

#include <Eigen/Core>
#include <optional>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/optimization/pose_optimization.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct MotionPriorOptions {
  // Matches of a frame from which on it is placed by what it sees alone; 0: always.
  int min_matches = 200;
  // Least standard deviation of the expected place over the usual way from frame to frame: a car's.
  double min_change_ratio = 0.02;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("min_matches", min_matches,
                  "matches below which the place expected by constant velocity counts too");
    visitor.Field("min_change_ratio", min_change_ratio,
                  "least uncertainty of that place over the usual way from frame to frame");
  }
};

// Where the camera is expected by constant velocity, and how far from there it usually is: learned
// from the frames that see enough, so that it says much of a car and little of a hand. Over a
// crest, where what was near is gone and only far things and repeated ones (a crash barrier) are
// seen, such a place keeps the scale, which is otherwise lost without a sign. Not in the paper, nor
// in ORB-SLAM.
class MotionPrior {
 public:
  explicit MotionPrior(const MotionPriorOptions& options) : options_(options) {}

  // Of the next frame, in world coordinates.
  void Expect(const Rigid3d& last_cam_from_world, const Rigid3d& cam_from_world);
  // The next frame is not expected anywhere.
  void Forget() { expected_.reset(); }

  // None when the frame has enough matches or was not expected anywhere.
  CenterPrior For(int num_matches) const;
  // The frame's place was found.
  void Learn(const Rigid3d& cam_from_world);
  // Lengths of the map were multiplied by `scale`.
  void Rescale(double scale);

 private:
  struct Expected {
    Eigen::Vector3d center;
    double way;  // from the last frame's centre, map units
  };

  MotionPriorOptions options_;
  std::optional<Expected> expected_;
  double usual_way_ = 0.0;     // from frame to frame while the camera moves, map units; 0: unknown
  double change_ratio_ = 0.1;  // usual distance from the expected place over that way
};

}  // namespace lift_slam
