#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "lift_slam/place_recognition/keyframe_database.h"
#include "lift_slam/util/options.h"

namespace lift_slam {

// Which of the keyframes that look alike may be the same place (ORB-SLAM sec. VII-A; paper sec.
// 3.2 "Relocalization and loop closure"). Pure functions on ids and scores; the covisibility
// graph is asked for through a function.

// Keyframes covisible with the given one, best first; without itself. Must not change between calls
// that belong together.
using CovisibleKeyframes = std::function<std::vector<int>(int keyframe)>;

// Why a keyframe that looks alike is not taken for the same place.
enum class CandidateRejection {
  kAccepted,
  kFewCommonWords,  // fewer than a share of the most that any candidate has
  kLowScore,        // far less alike than a covisible neighbour of the query
  kWeakGroup,       // it and its covisible candidates together score far below the best group
  kNotBestOfGroup,  // a covisible candidate of a kept group is better and stands for it
  kInconsistent,    // its place was not recognised in enough keyframes in a row (yet)
  kCount
};
inline constexpr std::size_t kNumCandidateRejections =
    static_cast<std::size_t>(CandidateRejection::kCount);
std::string_view Name(CandidateRejection rejection);  // "few_common_words"
// One sentence for people.
std::string_view Explain(CandidateRejection rejection);

struct CandidateSelectionOptions {
  double min_common_words_ratio = 0.8;  // of the most common words of any candidate
  // Of the least score among the covisible keyframes of the query (ORB-SLAM: 1). They are seen in
  // the same light; a place seen in other light scores a third of it, and geometry decides.
  double min_score_ratio = 0.3;
  double min_group_score_ratio = 0.75;  // of the best group's accumulated score
  int group_size = 10;                  // best covisible keyframes that score with a candidate
  // Keyframes in a row that must recognise the same group of covisible keyframes; 1: at once, to be
  // verified by geometry alone.
  int min_consistent_keyframes = 3;

  void Visit(OptionVisitor& visitor);
};

// What became of one candidate.
struct CandidateVerdict {
  PlaceCandidate candidate;
  double group_score = 0.0;  // of its group; 0 when it did not come so far
  int consistency = 0;       // keyframes in a row, this one included; 0: did not come so far
  CandidateRejection rejection = CandidateRejection::kAccepted;
};

// The least score between the query and its covisible keyframes' bags, by which the least score of
// a loop calibrates itself to the scene and the vocabulary. 0 without neighbours; nullptr entries
// are passed over.
double LeastCovisibleScore(const BagOfWords& query, std::span<const BagOfWords* const> covisible,
                           BagScore score);

// Filters by common words and score, accumulates scores over covisibility groups, and keeps the
// best of each strong group. One verdict a candidate, in their order; accepted ones have yet to be
// consistent. With a least covisible score of 0 the selection for relocalisation.
std::vector<CandidateVerdict> SelectCandidates(std::span<const PlaceCandidate> candidates,
                                               double least_covisible_score,
                                               const CovisibleKeyframes& covisible,
                                               const CandidateSelectionOptions& options);

// A group of covisible keyframes that the last keyframe recognised.
struct RecognizedGroup {
  std::vector<int> keyframes;  // ascending
  int consistency = 0;         // keyframes in a row that recognised it or a group that overlaps it
};

// Compares the groups (a candidate and all of its covisible keyframes) of accepted verdicts with
// those of the keyframe before: an accepted candidate needs as many in a row as the options say,
// else it becomes kInconsistent. Returns the groups for the next keyframe; without accepted
// candidates these are none. Call it for every keyframe in order.
std::vector<RecognizedGroup> CheckConsistency(std::span<const RecognizedGroup> previous,
                                              const CovisibleKeyframes& covisible,
                                              const CandidateSelectionOptions& options,
                                              std::vector<CandidateVerdict>& verdicts);

}  // namespace lift_slam
