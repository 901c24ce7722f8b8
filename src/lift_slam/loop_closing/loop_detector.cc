#include "lift_slam/loop_closing/loop_detector.h"

#include <algorithm>
#include <set>

namespace lift_slam {
namespace {

double LeastScoreAround(const PlaceView& query, const LoopClosingOptions& options) {
  std::vector<const BagOfWords*> bags;
  for (const auto& neighbor :
       query.map.covisibility().Neighbors(query.keyframe, options.min_shared_points)) {
    bags.push_back(query.places.database().Find(neighbor.keyframe.value));
  }
  return LeastCovisibleScore(query.places.Bag(query.keyframe), bags, options.score);
}

// The query, its covisible keyframes and theirs, and all that came shortly before it.
std::vector<int> KeyframesAround(const PlaceView& query, const LoopClosingOptions& options) {
  std::set<int> around;
  const CovisibleKeyframes covisible = CovisibleIn(query.map, options.min_shared_points);
  for (const int first : covisible(query.keyframe.value)) {
    around.insert(first);
    for (const int second : covisible(first)) around.insert(second);
  }
  const int newest = query.keyframe.value;
  for (int id = std::max(0, newest - options.min_keyframes_apart + 1); id <= newest; ++id) {
    around.insert(id);
  }
  return {around.begin(), around.end()};
}

}  // namespace

std::vector<CandidateVerdict> LoopDetector::Detect(const PlaceView& query) {
  const auto candidates = query.places.database().Query(query.places.Bag(query.keyframe),
                                                        KeyframesAround(query, options_));
  const CovisibleKeyframes covisible = CovisibleIn(query.map, options_.min_shared_points);
  std::vector<CandidateVerdict> verdicts = SelectCandidates(
      candidates, LeastScoreAround(query, options_), covisible, options_.candidates);
  groups_ = CheckConsistency(groups_, covisible, options_.candidates, verdicts);
  return verdicts;
}

std::vector<CandidateVerdict> DetectInOtherMap(const PlaceView& query, const Map& other_map,
                                               const PlaceIndex& other_places,
                                               const LoopClosingOptions& options) {
  const auto candidates = other_places.database().Query(query.places.Bag(query.keyframe));
  return SelectCandidates(candidates, LeastScoreAround(query, options),
                          CovisibleIn(other_map, options.min_shared_points), options.candidates);
}

std::vector<KeyFrameId> FindSimilarKeyFrames(const FrameFeatures& features, const Map& map,
                                             const PlaceIndex& places,
                                             const LoopClosingOptions& options, int max_count) {
  const auto candidates = places.database().Query(places.WordsOf(features).bag);
  std::vector<KeyFrameId> similar;
  for (const CandidateVerdict& verdict : SelectCandidates(
           candidates, 0.0, CovisibleIn(map, options.min_shared_points), options.candidates)) {
    if (static_cast<int>(similar.size()) == max_count) break;
    if (verdict.rejection == CandidateRejection::kAccepted) {
      similar.emplace_back(verdict.candidate.keyframe);
    }
  }
  return similar;
}

}  // namespace lift_slam
