#include "lift_slam/tracking/tracking_state.h"

#include <array>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

struct RefusalText {
  std::string_view name, explanation;
};

constexpr std::array<RefusalText, static_cast<std::size_t>(FrameRefusal::kCount)> kRefusals = {{
    {"none", "The frame has a pose."},
    {"first_frame", "The first frame of a map has nothing to be compared with."},
    {"too_few_features",
     "Too few features were found: the image is dark, blurred or without texture."},
    {"too_few_matches", "Too few features match the reference frame: the view changed too fast."},
    {"low_parallax",
     "The camera has hardly moved since the reference frame: a map needs sideways motion."},
    {"pure_rotation", "The camera only turned: a map needs a change of position."},
    {"ambiguous_planar",
     "The view is one plane that two motions explain equally well: show more depth."},
    {"too_few_points", "Too few points lie in front of both cameras."},
    {"poor_reconstruction", "The first map did not survive bundle adjustment."},
    {"too_few_tracked", "Too few map points were found again in the image."},
    {"pose_rejected", "No pose agrees with enough map points."},
    {"place_not_recognized", "The image shows no place of the loaded maps."},
    {"image_unreadable", "The image could not be decoded."},
    {"image_size_differs", "The image's size is not that of the calibration."},
    {"timestamp_not_increasing", "The timestamp is not after the one before."},
}};

const RefusalText& TextOf(FrameRefusal refusal) {
  const auto i = static_cast<std::size_t>(refusal);
  LIFT_SLAM_CHECK(i < kRefusals.size(), "refusal {}", i);
  return kRefusals[i];
}

}  // namespace

std::string_view Name(TrackingState state) {
  switch (state) {
    case TrackingState::kInitializing:
      return "initializing";
    case TrackingState::kTracking:
      return "tracking";
    case TrackingState::kLost:
      return "lost";
  }
  return "unknown";
}

std::string_view Name(FrameRefusal refusal) { return TextOf(refusal).name; }

std::string_view Explain(FrameRefusal refusal) { return TextOf(refusal).explanation; }

}  // namespace lift_slam
