#include "lift_slam/loop_closing/place_match.h"

namespace lift_slam {

std::string_view Name(PlaceRejection rejection) {
  switch (rejection) {
    case PlaceRejection::kAccepted:
      return "accepted";
    case PlaceRejection::kFewWordMatches:
      return "few_word_matches";
    case PlaceRejection::kNoSimilarity:
      return "no_similarity";
    case PlaceRejection::kFewInliers:
      return "few_inliers";
    case PlaceRejection::kTooFarAway:
      return "too_far_away";
    case PlaceRejection::kFewProjected:
      return "few_projected";
    case PlaceRejection::kFewFound:
      return "few_found";
    case PlaceRejection::kNotConfirmed:
      return "not_confirmed";
    case PlaceRejection::kNotRepeated:
      return "not_repeated";
    case PlaceRejection::kTooMuchDrift:
      return "too_much_drift";
    case PlaceRejection::kGraphFailed:
      return "graph_failed";
    case PlaceRejection::kCount:
      break;
  }
  return "unknown";
}

std::string_view Explain(PlaceRejection rejection) {
  switch (rejection) {
    case PlaceRejection::kAccepted:
      return "The same place.";
    case PlaceRejection::kFewWordMatches:
      return "Too few map points have descriptors that match.";
    case PlaceRejection::kNoSimilarity:
      return "The matches do not agree on one position of the camera.";
    case PlaceRejection::kFewInliers:
      return "Too few matches agree with the best position of the camera.";
    case PlaceRejection::kTooFarAway:
      return "The place is seen from too far away to say where the camera is.";
    case PlaceRejection::kFewProjected:
      return "Too few points of the place are found where they should be seen.";
    case PlaceRejection::kFewFound:
      return "Too little of each place is seen from the other: only some texture repeats itself.";
    case PlaceRejection::kNotConfirmed:
      return "The keyframes before do not see the place.";
    case PlaceRejection::kNotRepeated:
      return "No other keyframe nearby says the same, moved on by its own way (yet).";
    case PlaceRejection::kTooMuchDrift:
      return "It would mean more drift than the way between both places can have made.";
    case PlaceRejection::kGraphFailed:
      return "The correction of the map could not be computed.";
    case PlaceRejection::kCount:
      break;
  }
  return "unknown";
}

}  // namespace lift_slam
