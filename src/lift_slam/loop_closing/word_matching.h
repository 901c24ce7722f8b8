#pragma once

#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/matching/feature_matcher.h"
#include "lift_slam/place_recognition/bag_of_words.h"

namespace lift_slam {

// Features of keyframe `a` with those of `b` that have map points, matched within the nodes of the
// direct index: nearest neighbour up to `max_distance`, with ratio and rotation checks; each
// feature of `b` is used once, by its nearest. In order of a.
std::vector<FeatureMatch> MatchPointsByWords(const KeyFrame& a, const DirectIndex& a_words,
                                             const KeyFrame& b, const DirectIndex& b_words,
                                             float max_distance);

}  // namespace lift_slam
