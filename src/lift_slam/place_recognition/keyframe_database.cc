#include "lift_slam/place_recognition/keyframe_database.h"

#include <algorithm>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

struct SharedWords {
  int count = 0;
  double sum = 0.0;  // of SharedWordTerm, in order of word
};

bool IsBetter(const PlaceCandidate& a, const PlaceCandidate& b) {
  return a.score != b.score ? a.score > b.score : a.keyframe < b.keyframe;
}

}  // namespace

const BagOfWords* KeyframeDatabase::Find(int keyframe) const {
  const auto found = bags_.find(keyframe);
  return found == bags_.end() ? nullptr : &found->second;
}

void KeyframeDatabase::Add(int keyframe, BagOfWords bag) {
  const auto [entry, is_new] = bags_.emplace(keyframe, std::move(bag));
  LIFT_SLAM_CHECK(is_new, "keyframe {} is in the database already", keyframe);
  for (const WordWeight& word : entry->second.words) {
    postings_[word.word].push_back({keyframe, word.weight});
  }
}

void KeyframeDatabase::Remove(int keyframe) {
  const auto entry = bags_.find(keyframe);
  if (entry == bags_.end()) return;
  for (const WordWeight& word : entry->second.words) {
    const auto postings = postings_.find(word.word);
    std::erase_if(postings->second, [&](const Posting& p) { return p.keyframe == keyframe; });
    if (postings->second.empty()) postings_.erase(postings);
  }
  bags_.erase(entry);
}

std::vector<PlaceCandidate> KeyframeDatabase::Query(const BagOfWords& bag,
                                                    std::span<const int> excluded) const {
  std::unordered_map<int, SharedWords> shared;
  for (const WordWeight& word : bag.words) {
    const auto postings = postings_.find(word.word);
    if (postings == postings_.end()) continue;
    for (const Posting& posting : postings->second) {
      SharedWords& entry = shared[posting.keyframe];
      ++entry.count;
      entry.sum += SharedWordTerm(word.weight, posting.weight, score_);
    }
  }
  for (const int keyframe : excluded) shared.erase(keyframe);
  std::vector<PlaceCandidate> candidates;
  candidates.reserve(shared.size());
  for (const auto& [keyframe, words] : shared) {
    candidates.push_back(
        {keyframe, words.count, ScoreFromSum(words.sum, bag, bags_.at(keyframe), score_)});
  }
  std::sort(candidates.begin(), candidates.end(), IsBetter);
  return candidates;
}

}  // namespace lift_slam
