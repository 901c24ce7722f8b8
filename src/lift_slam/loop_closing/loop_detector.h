#pragma once

#include <vector>

#include "lift_slam/loop_closing/loop_closing_options.h"
#include "lift_slam/loop_closing/place_verifier.h"

namespace lift_slam {

// Which keyframes may show the place of the newest one (ORB-SLAM sec. VII-A): one verdict for each
// that has words in common, the best first.
class LoopDetector {
 public:
  explicit LoopDetector(const LoopClosingOptions& options) : options_(options) {}

  // Candidates within the query's own map; call for each keyframe in order, as the consistency
  // over keyframes is counted here.
  std::vector<CandidateVerdict> Detect(const PlaceView& query);
  // Nothing was recognised lately: the keyframes so far do not count any more.
  void Reset() { groups_.clear(); }

 private:
  LoopClosingOptions options_;
  std::vector<RecognizedGroup> groups_;
};

// Candidates within another map, consistent or not: geometry must tell.
std::vector<CandidateVerdict> DetectInOtherMap(const PlaceView& query, const Map& other_map,
                                               const PlaceIndex& other_places,
                                               const LoopClosingOptions& options);

// Keyframes of a map that look like an image, best first, at most `max_count`: where a lost camera
// may be.
std::vector<KeyFrameId> FindSimilarKeyFrames(const FrameFeatures& features, const Map& map,
                                             const PlaceIndex& places,
                                             const LoopClosingOptions& options, int max_count);

}  // namespace lift_slam
