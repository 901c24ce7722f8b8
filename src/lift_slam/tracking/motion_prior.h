#pragma once

#include <Eigen/Core>
#include <optional>

#include "lift_slam/geometry/rigid3.h"
#include "lift_slam/optimization/pose_optimization.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct MotionPriorOptions {
  // Share of a frame's features that are matched from which on it is placed by what it sees alone;
  // 0: every frame is. A share, since there are half as many of LIFT's as of ORB's.
  double min_match_share = 0.15;
  // Least standard deviation of the expected place over the way from frame to frame: a car that
  // brakes.
  double min_change_ratio = 0.04;

  void Visit(OptionVisitor& visitor) {
    visitor.Field(
        "min_match_share", min_match_share,
        "matched share of the features below which the place expected by constant velocity counts "
        "too; 0: never");
    visitor.Field("min_change_ratio", min_change_ratio,
                  "least uncertainty of that place over the way from frame to frame");
  }
  // Throws InputError naming the option that is out of range.
  void Check() const;
};

// Where the camera is expected by constant velocity, and how far from there it usually is, which
// the run shows: it says much of a car and little of a hand. Over a crest, where what was near is
// gone and only far things and repeated ones (a crash barrier) are seen, such a place keeps the
// scale, which is otherwise lost without a sign (docs/scale.md). Not in the paper, nor in
// ORB-SLAM. Where all frames see little, what is usual is learned from frames that the prior had a
// share in, and may fall to the least.
class MotionPrior {
 public:
  explicit MotionPrior(const MotionPriorOptions& options) : options_(options) {}

  // The next frame is expected at `cam_from_world`, one frame after `last_cam_from_world`.
  void Expect(const Rigid3d& last_cam_from_world, const Rigid3d& cam_from_world);
  // The next frame is not expected anywhere.
  void Forget() { expected_.reset(); }

  // None when the frame has enough matches, was not expected anywhere, or what is usual is not
  // known yet.
  CenterPrior For(int num_matches, int num_features) const;
  // The frame was found there.
  void Learn(const Rigid3d& cam_from_world);
  // Lengths of the map were multiplied by `scale`.
  void Rescale(double scale);

 private:
  struct Expected {
    Eigen::Vector3d center;  // world
    double way = 0.0;        // from the last frame's centre, map units
  };
  // Never less than the usual way: a camera that stands may start.
  double Way() const;

  MotionPriorOptions options_;
  std::optional<Expected> expected_;
  double usual_way_ = 0.0;     // from frame to frame while the camera moves, map units
  double change_ratio_ = 0.0;  // usual distance from the expected place over the way
  int num_learned_ = 0;        // frames
};

}  // namespace lift_slam
