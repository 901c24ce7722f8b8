#pragma once

#include <string_view>

namespace lift_slam {

enum class TrackingState { kInitializing, kTracking, kLost };

// Why a frame got no pose, or (kNone) that it got one. Counted over a run and shown to the user.
enum class FrameRefusal {
  kNone,
  // no map yet
  kFirstFrame,          // nothing to compare with
  kTooFewFeatures,      // dark, blurred or textureless image
  kTooFewMatches,       // too few matches with the reference frame
  kLowParallax,         // the camera has hardly moved
  kPureRotation,        // matches agree with a rotation alone
  kAmbiguousPlanar,     // two planar reconstructions fit equally well
  kTooFewPoints,        // too few points in front of both cameras
  kPoorReconstruction,  // bundle adjustment of the first map did not keep enough points
  // a map exists
  kTooFewTracked,       // too few map points matched in the image
  kPoseRejected,        // too few matches agree with any pose
  kPlaceNotRecognized,  // localisation alone: no loaded map shows the image's place
  // before the tracker
  kImageUnreadable,
  kImageSizeDiffers,
  kTimestampNotIncreasing,
  kCount
};

// Lower-case words with underscores, as in result.json: "low_parallax".
std::string_view Name(TrackingState state);
std::string_view Name(FrameRefusal refusal);
// One sentence for people: what it means and what may help.
std::string_view Explain(FrameRefusal refusal);

}  // namespace lift_slam
