#pragma once

#include <string_view>
#include <vector>

#include "lift_slam/geometry/sim3.h"
#include "lift_slam/map/ids.h"

namespace lift_slam {

// Why a keyframe that looks like another one was not taken for the same place by geometry.
enum class PlaceRejection {
  kAccepted,
  kFewWordMatches,  // too few map points match by descriptors
  kNoSimilarity,    // the matches agree on no similarity
  kFewInliers,      // too few agree after its optimisation
  kTooFarAway,      // it shows the place, but from so far that the similarity is rough
  kFewProjected,    // too few of the place's points are found where it puts them
  kFewFound,        // either sees too little of the other, as where only a texture repeats itself
  kNotConfirmed,    // the keyframes around the query do not see the place's points
  kNotRepeated,     // no other keyframe nearby says the same (yet)
  kTooMuchDrift,    // it would mean more drift than the way between both can have made
  kGraphFailed,     // the pose graph could not be solved; the map is as it was
  kCount
};
std::string_view Name(PlaceRejection rejection);     // "few_word_matches"
std::string_view Explain(PlaceRejection rejection);  // one sentence for people

// How far the verification of a candidate came, and what it found.
struct PlaceMatch {
  PlaceRejection rejection = PlaceRejection::kAccepted;
  int num_word_matches = 0;      // by descriptors alone
  int num_ransac_inliers = 0;    // that agree on a pose
  int num_inliers = 0;           // of the optimised similarity, both sides with map points
  int num_projected = 0;         // features of the query that show a point of the place
  double found_ratio = 0.0;      // these over the place's points that the query should see
  double own_found_ratio = 0.0;  // the same for the points around the query itself
  // The same from the place's side: of the points around the query those that the candidate should
  // see and does, and of the points around the candidate itself.
  double reverse_found_ratio = 0.0, reverse_own_found_ratio = 0.0;
  double mutual_ratio = 0.0;  // geometric mean of both shares, each over the own one
  // Distance between both cameras over the median depth of the candidate's points.
  double offset_ratio = 0.0;
  int num_confirming = 0;  // covisible keyframes of the query that see the place too
  // Camera coordinates of the query, in its map's units, from the candidate's map.
  Sim3d query_from_candidate_world;
  std::vector<MapPointId> points;  // by feature of the query: point of the candidate's map
};

}  // namespace lift_slam
