#include "lift_slam/place_recognition/loop_candidates.h"

#include <algorithm>
#include <limits>
#include <map>

namespace lift_slam {
namespace {

// A candidate, the covisible candidates with it, and the best of them.
struct Group {
  std::size_t seed = 0;  // indices of verdicts
  std::size_t best = 0;
  double score = 0.0;
};

void RejectByWordsAndScore(double min_score, const CandidateSelectionOptions& options,
                           std::vector<CandidateVerdict>& verdicts) {
  int most = 0;
  for (const CandidateVerdict& v : verdicts) most = std::max(most, v.candidate.common_words);
  const double min_words = options.min_common_words_ratio * most;
  for (CandidateVerdict& verdict : verdicts) {
    if (verdict.candidate.common_words < min_words) {
      verdict.rejection = CandidateRejection::kFewCommonWords;
    } else if (verdict.candidate.score < min_score) {
      verdict.rejection = CandidateRejection::kLowScore;
    }
  }
}

// Candidates with enough common words score for their groups, whatever their own score (as in
// ORB-SLAM); only those above the least score stand for a group.
Group MakeGroup(std::size_t seed, const std::vector<CandidateVerdict>& verdicts,
                const std::map<int, std::size_t>& index_of, const CovisibleKeyframes& covisible,
                int group_size) {
  Group group{seed, seed, verdicts[seed].candidate.score};
  int left = group_size;
  for (const int keyframe : covisible(verdicts[seed].candidate.keyframe)) {
    if (left-- == 0) break;
    const auto found = index_of.find(keyframe);
    if (found == index_of.end()) continue;
    const CandidateVerdict& other = verdicts[found->second];
    if (other.rejection == CandidateRejection::kFewCommonWords) continue;
    group.score += other.candidate.score;
    const bool is_better = other.candidate.score > verdicts[group.best].candidate.score;
    if (is_better && other.rejection == CandidateRejection::kAccepted) group.best = found->second;
  }
  return group;
}

std::vector<Group> MakeGroups(const std::vector<CandidateVerdict>& verdicts,
                              const CovisibleKeyframes& covisible, int group_size) {
  std::map<int, std::size_t> index_of;
  for (std::size_t i = 0; i < verdicts.size(); ++i) index_of[verdicts[i].candidate.keyframe] = i;
  std::vector<Group> groups;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i].rejection != CandidateRejection::kAccepted) continue;
    groups.push_back(MakeGroup(i, verdicts, index_of, covisible, group_size));
  }
  return groups;
}

std::vector<int> KeyframesOfGroup(int keyframe, const CovisibleKeyframes& covisible) {
  std::vector<int> keyframes = covisible(keyframe);
  keyframes.push_back(keyframe);
  std::sort(keyframes.begin(), keyframes.end());
  return keyframes;
}

bool Overlap(const std::vector<int>& a, const std::vector<int>& b) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    if (*i == *j) return true;
    *i < *j ? ++i : ++j;
  }
  return false;
}

}  // namespace

double LeastCovisibleScore(const BagOfWords& query, std::span<const BagOfWords* const> covisible,
                           BagScore score) {
  double least = std::numeric_limits<double>::infinity();
  for (const BagOfWords* bag : covisible) {
    if (bag != nullptr) least = std::min(least, Score(query, *bag, score));
  }
  return least < std::numeric_limits<double>::infinity() ? least : 0.0;
}

std::vector<CandidateVerdict> SelectCandidates(std::span<const PlaceCandidate> candidates,
                                               double least_covisible_score,
                                               const CovisibleKeyframes& covisible,
                                               const CandidateSelectionOptions& options) {
  std::vector<CandidateVerdict> verdicts;
  for (const PlaceCandidate& candidate : candidates) verdicts.push_back({candidate});
  RejectByWordsAndScore(options.min_score_ratio * least_covisible_score, options, verdicts);
  const std::vector<Group> groups = MakeGroups(verdicts, covisible, options.group_size);
  double best_score = 0.0;
  for (const Group& group : groups) best_score = std::max(best_score, group.score);
  for (const Group& group : groups) {
    const bool is_weak = group.score < options.min_group_score_ratio * best_score;
    verdicts[group.seed].group_score = group.score;
    verdicts[group.seed].rejection =
        is_weak ? CandidateRejection::kWeakGroup : CandidateRejection::kNotBestOfGroup;
  }
  for (const Group& group : groups) {
    if (group.score < options.min_group_score_ratio * best_score) continue;
    verdicts[group.best].rejection = CandidateRejection::kAccepted;
  }
  return verdicts;
}

std::vector<RecognizedGroup> CheckConsistency(std::span<const RecognizedGroup> previous,
                                              const CovisibleKeyframes& covisible,
                                              const CandidateSelectionOptions& options,
                                              std::vector<CandidateVerdict>& verdicts) {
  std::vector<RecognizedGroup> groups;
  for (CandidateVerdict& verdict : verdicts) {
    if (verdict.rejection != CandidateRejection::kAccepted) continue;
    RecognizedGroup group{KeyframesOfGroup(verdict.candidate.keyframe, covisible), 1};
    for (const RecognizedGroup& before : previous) {
      if (before.consistency + 1 <= group.consistency) continue;
      if (Overlap(group.keyframes, before.keyframes)) group.consistency = before.consistency + 1;
    }
    verdict.consistency = group.consistency;
    if (group.consistency < options.min_consistent_keyframes) {
      verdict.rejection = CandidateRejection::kInconsistent;
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

std::string_view Name(CandidateRejection rejection) {
  switch (rejection) {
    case CandidateRejection::kAccepted:
      return "accepted";
    case CandidateRejection::kFewCommonWords:
      return "few_common_words";
    case CandidateRejection::kLowScore:
      return "low_score";
    case CandidateRejection::kWeakGroup:
      return "weak_group";
    case CandidateRejection::kNotBestOfGroup:
      return "not_best_of_group";
    case CandidateRejection::kInconsistent:
      return "inconsistent";
    case CandidateRejection::kCount:
      break;
  }
  return "unknown";
}

std::string_view Explain(CandidateRejection rejection) {
  switch (rejection) {
    case CandidateRejection::kAccepted:
      return "The place was recognised.";
    case CandidateRejection::kFewCommonWords:
      return "Too few visual words in common.";
    case CandidateRejection::kLowScore:
      return "Far less alike than the keyframes around the query.";
    case CandidateRejection::kWeakGroup:
      return "Its group of covisible keyframes is far less alike than the best.";
    case CandidateRejection::kNotBestOfGroup:
      return "Another keyframe of its group stands for it.";
    case CandidateRejection::kInconsistent:
      return "Its place was not recognised in enough keyframes in a row.";
    case CandidateRejection::kCount:
      break;
  }
  return "unknown";
}

void CandidateSelectionOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("min_common_words_ratio", min_common_words_ratio,
                "least common words, of the most of any candidate");
  visitor.Field("min_score_ratio", min_score_ratio,
                "least score of a candidate, of that among covisible keyframes of the query");
  visitor.Field("min_group_score_ratio", min_group_score_ratio,
                "least accumulated score of a covisibility group, of the best");
  visitor.Field("group_size", group_size, "covisible keyframes that score with a candidate");
  visitor.Field("min_consistent_keyframes", min_consistent_keyframes,
                "keyframes in a row that must recognise the place; 1: at once");
}

}  // namespace lift_slam
