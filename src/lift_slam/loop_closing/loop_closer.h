#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "lift_slam/loop_closing/loop_bundle.h"
#include "lift_slam/loop_closing/loop_confirmation.h"
#include "lift_slam/loop_closing/loop_corrector.h"
#include "lift_slam/loop_closing/loop_detector.h"

namespace lift_slam {

// A candidate that was verified by geometry.
struct PlaceAttempt {
  LoopEdge edge;
  double score = 0.0;  // of the words
  PlaceMatch match;
};

// What a keyframe brought.
struct LoopReport {
  // Candidates by words alone, by CandidateRejection; accepted ones went on to verification, the
  // best of them up to the limit.
  std::array<int, kNumCandidateRejections> candidates{};
  std::vector<PlaceAttempt> attempts;        // in order; the last is the accepted one, if any
  std::optional<LoopCorrection> correction;  // a loop was closed
  // That of an earlier loop was merged, before anything else.
  std::optional<LoopBundleReport> bundle;
  double detect_ms = 0.0, verify_ms = 0.0;

  bool closed() const { return correction.has_value(); }
};

// Loop closing in one map (paper sec. 3.2 "Relocalization and loop closure"): keeps the map's
// place index and spanning tree; detects, verifies and corrects in the calling thread.
class LoopCloser {
 public:
  LoopCloser(const LoopClosingOptions& options, std::shared_ptr<const Vocabulary> vocabulary,
             std::uint64_t seed)
      : options_(options),
        seed_(seed),
        places_(std::move(vocabulary), options.score),
        detector_(options),
        confirmation_(options.confirmation),
        bundle_(options.bundle) {}

  // Call once for each new keyframe after local mapping. Closes at most one loop; what the caller
  // keeps relative to the map's keyframes must then follow (LoopCorrection, LoopBundleReport).
  LoopReport Process(KeyFrameId keyframe, Map& map);

  // Recognises the keyframe of `map` in another map, whose closer is given. The last attempt of the
  // report is accepted, or there is none; nothing is changed. The keyframe must have been
  // processed.
  LoopReport FindInOtherMap(KeyFrameId keyframe, const Map& map, const Map& other_map,
                            const LoopCloser& other) const;

  // Keyframes of the map where a lost camera may be, best first.
  std::vector<KeyFrameId> FindSimilar(const FrameFeatures& features, const Map& map) const;

  // Takes up a map that an earlier run has made, with the loops closed in it.
  void Restore(const Map& map, std::vector<LoopEdge> loops);
  // Brings index and tree up to date with the map's keyframes.
  void Update(const Map& map);
  // An adjustment of the whole map that is under way is not merged any more.
  void GiveUpBundle() { bundle_.GiveUp(); }
  // The other closer's map has been absorbed (Map::Absorb), with ids moved up by `offset`, for the
  // loop's edge (ids of this map). `newest`: of this map then; the next keyframe comes after it.
  void Absorb(const LoopCloser& other, int offset, const LoopEdge& merged_by, KeyFrameId newest);

  const std::vector<LoopEdge>& loops() const { return loops_; }
  const SpanningTree& tree() const { return tree_; }

 private:
  void Verify(const PlaceView& query, const std::vector<CandidateVerdict>& verdicts,
              const Map& other_map, const PlaceIndex& other_places, LoopReport& report) const;

  LoopClosingOptions options_;
  std::uint64_t seed_;
  PlaceIndex places_;
  SpanningTree tree_;
  LoopDetector detector_;
  LoopConfirmation confirmation_;
  LoopBundle bundle_;
  std::vector<LoopEdge> loops_;
  KeyFrameId last_loop_;  // its query
};

}  // namespace lift_slam
