#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "lift_slam/place_recognition/bag_of_words.h"

namespace lift_slam {

// A keyframe that shares words with the one asked about.
struct PlaceCandidate {
  int keyframe = -1;
  int common_words = 0;
  double score = 0.0;  // Score() of the two bags
  friend bool operator==(const PlaceCandidate&, const PlaceCandidate&) = default;
};

// Which keyframes have which words (inverted index). Ids are the caller's, such as those of the
// map's keyframes. A query walks through the keyframes of the image's words only, so its time
// depends on how common these are, not on the number of keyframes. Not safe for threads while it
// changes.
class KeyframeDatabase {
 public:
  explicit KeyframeDatabase(BagScore score) : score_(score) {}

  BagScore score() const { return score_; }
  std::size_t size() const { return bags_.size(); }
  // The keyframe's words; nullptr when it is not in the database.
  const BagOfWords* Find(int keyframe) const;

  // The id must not be in the database yet.
  void Add(int keyframe, BagOfWords bag);
  // Nothing when it is not there.
  void Remove(int keyframe);

  // All keyframes that share a word with `bag`, but `excluded` (in any order: the covisible ones,
  // say); best score first, equal ones by id. The order of adding and removing has no influence.
  std::vector<PlaceCandidate> Query(const BagOfWords& bag,
                                    std::span<const int> excluded = {}) const;

 private:
  struct Posting {
    int keyframe = -1;
    float weight = 0.0F;
  };

  BagScore score_;
  std::map<int, BagOfWords> bags_;
  std::unordered_map<std::uint32_t, std::vector<Posting>> postings_;  // by word; only looked up
};

}  // namespace lift_slam
