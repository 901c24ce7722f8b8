#pragma once

#include "lift_slam/geometry/absolute_pose.h"
#include "lift_slam/optimization/pose_optimization.h"
#include "lift_slam/tracking/keyframe_decision.h"
#include "lift_slam/tracking/motion_prior.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

struct TrackerOptions {
  // Around the predicted place, on level 0. Narrow: in a row of like things, such as the posts of a
  // fence, a wide window takes the next one for the one that was seen.
  double search_radius_px = 5.0;
  // Share of the last frame's points that must be found, else the window is widened three times.
  double min_match_share = 0.4;
  int min_matches = 20;        // with the last frame; else the next, wider search
  int min_inliers_first = 10;  // after the first pose optimisation
  int min_inliers = 30;        // after the local map; fewer: lost
  // The same for a frame that is held to the place where the motion prior expects it.
  int min_inliers_expected = 20;
  int min_relocalised_inliers = 50;  // the same for a lost frame found by its look (as ORB-SLAM)
  // Share of the points that such a frame should see and does, over the usual share: where only a
  // texture repeats, most of them are missing.
  double min_relocalised_ratio = 0.4;
  int max_local_keyframes = 60;  // of the local map
  int recovery_keyframes = 5;    // recent keyframes matched without prediction when lost
  PoseOptimizationOptions pose;
  AbsolutePoseOptions absolute_pose;
  MotionPriorOptions motion_prior;
  KeyFrameDecisionOptions keyframe;

  void Visit(OptionVisitor& visitor) {
    visitor.Field("search_radius_px", search_radius_px,
                  "window around the predicted place of a point, on the full-size level");
    visitor.Field("min_match_share", min_match_share,
                  "share of the last frame's points below which the window is widened");
    visitor.Field("min_matches", min_matches, "matches with the last frame before a wider search");
    visitor.Field("min_inliers_first", min_inliers_first,
                  "points that must agree with the first pose");
    visitor.Field("min_inliers", min_inliers, "tracked points below which a frame is lost");
    visitor.Field("min_inliers_expected", min_inliers_expected,
                  "the same for a frame that is held to its expected place as well");
    visitor.Field("min_relocalised_inliers", min_relocalised_inliers,
                  "tracked points that a lost frame found by its look needs");
    visitor.Field("min_relocalised_ratio", min_relocalised_ratio,
                  "share of visible points that it sees, over the usual share");
    visitor.Field("max_local_keyframes", max_local_keyframes, "keyframes of the local map");
    visitor.Field("recovery_keyframes", recovery_keyframes,
                  "keyframes tried without prediction when tracking fails");
    visitor.Group("pose", pose, "motion-only bundle adjustment");
    visitor.Group("absolute_pose", absolute_pose, "pose without prediction, by P3P");
    visitor.Group("motion_prior", motion_prior, "the expected place of a frame that sees little");
    visitor.Group("keyframe", keyframe, "when a frame becomes a keyframe");
  }
};

}  // namespace lift_slam
