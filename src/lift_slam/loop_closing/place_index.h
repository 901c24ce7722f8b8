#pragma once

#include <map>
#include <memory>
#include <vector>

#include "lift_slam/map/map.h"
#include "lift_slam/place_recognition/keyframe_database.h"
#include "lift_slam/place_recognition/loop_candidates.h"
#include "lift_slam/place_recognition/vocabulary.h"

namespace lift_slam {

// The words of a map's keyframes: which look like an image, and their features by node.
class PlaceIndex {
 public:
  PlaceIndex(std::shared_ptr<const Vocabulary> vocabulary, BagScore score)
      : vocabulary_(std::move(vocabulary)), database_(score) {}

  ImageWords WordsOf(const FrameFeatures& features) const;
  // The keyframe must not be in the index yet.
  void Add(const KeyFrame& keyframe);
  // Takes out keyframes that are no longer in the map.
  void ForgetErased(const Map& map);
  // Takes over the other index, whose ids have been moved up by `offset`.
  void Absorb(const PlaceIndex& other, int offset);

  const KeyframeDatabase& database() const { return database_; }
  bool Has(KeyFrameId keyframe) const { return direct_.count(keyframe) > 0; }
  // The keyframe must be in the index.
  const BagOfWords& Bag(KeyFrameId keyframe) const;
  const DirectIndex& Direct(KeyFrameId keyframe) const { return direct_.at(keyframe); }

 private:
  std::shared_ptr<const Vocabulary> vocabulary_;
  KeyframeDatabase database_;
  std::map<KeyFrameId, DirectIndex> direct_;
};

// Covisible keyframes of a map that share at least this many points, best first, for the functions
// of place_recognition/.
CovisibleKeyframes CovisibleIn(const Map& map, int min_shared_points);

}  // namespace lift_slam
