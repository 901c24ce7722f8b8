#include "lift_slam/loop_closing/loop_closer.h"

#include <algorithm>

#include "lift_slam/util/timer.h"

namespace lift_slam {
namespace {

void CountCandidates(const std::vector<CandidateVerdict>& verdicts, LoopReport& report) {
  for (const CandidateVerdict& verdict : verdicts) {
    ++report.candidates[static_cast<std::size_t>(verdict.rejection)];
  }
}

bool IsAccepted(const LoopReport& report) {
  return !report.attempts.empty() &&
         report.attempts.back().match.rejection == PlaceRejection::kAccepted;
}

// Length of the way along the keyframes from one to a later one.
double WayBetween(const Map& map, KeyFrameId first, KeyFrameId last) {
  double length = 0.0;
  const KeyFrame* before = nullptr;
  for (const KeyFrameId id : map.KeyFrameIds()) {
    if (id < first || last < id) continue;
    const KeyFrame& keyframe = map.keyframe(id);
    if (before != nullptr) length += (keyframe.Center() - before->Center()).norm();
    before = &keyframe;
  }
  return length;
}

// How far the loop says that the query is from where the map has it, over the way from the place.
double DriftRatio(const Map& map, const PlaceAttempt& attempt) {
  const Eigen::Vector3d claimed =
      Inverse(attempt.match.query_from_candidate_world) * Eigen::Vector3d::Zero();
  const double drift = (map.keyframe(attempt.edge.query).Center() - claimed).norm();
  const double way = WayBetween(map, std::min(attempt.edge.query, attempt.edge.candidate),
                                std::max(attempt.edge.query, attempt.edge.candidate));
  return way > 0.0 ? drift / way : 0.0;
}

}  // namespace

void LoopCloser::Update(const Map& map) {
  tree_.ForgetErased(map);
  places_.ForgetErased(map);
  for (const KeyFrameId id : map.KeyFrameIds()) {
    if (!tree_.Has(id)) tree_.Add(id, map);
    if (!places_.Has(id)) places_.Add(map.keyframe(id));
  }
}

void LoopCloser::Restore(const Map& map, std::vector<LoopEdge> loops) {
  loops_ = std::move(loops);
  Update(map);
}

LoopReport LoopCloser::Process(KeyFrameId keyframe, Map& map) {
  LoopReport report;
  const Timer detect_timer;
  Update(map);
  report.bundle = bundle_.KeyFrameAdded(tree_, map);
  const bool is_too_early =
      last_loop_.valid() && keyframe.value - last_loop_.value < options_.min_keyframes_after_loop;
  if (is_too_early) {
    detector_.Reset();
    report.detect_ms = detect_timer.ElapsedMs();
    return report;
  }
  const PlaceView query{map, places_, keyframe};
  const std::vector<CandidateVerdict> verdicts = detector_.Detect(query);
  CountCandidates(verdicts, report);
  report.detect_ms = detect_timer.ElapsedMs();
  Verify(query, verdicts, map, places_, report);
  if (!IsAccepted(report)) return report;

  PlaceAttempt& attempt = report.attempts.back();
  if (DriftRatio(map, attempt) > options_.max_drift_ratio) {
    attempt.match.rejection = PlaceRejection::kTooMuchDrift;
    return report;
  }
  if (!confirmation_.Confirms(keyframe, attempt.match.query_from_candidate_world, map)) {
    attempt.match.rejection = PlaceRejection::kNotRepeated;
    return report;
  }
  LoopCorrection correction =
      CorrectLoop(attempt.match, attempt.edge, tree_, loops_, options_.correction, map);
  last_loop_ = keyframe;
  detector_.Reset();
  confirmation_.Reset();
  if (correction.graph.usable) {
    loops_.push_back(attempt.edge);
    bundle_.Begin(map);
    report.correction = std::move(correction);
  } else {
    attempt.match.rejection = PlaceRejection::kGraphFailed;
  }
  return report;
}

LoopReport LoopCloser::FindInOtherMap(KeyFrameId keyframe, const Map& map, const Map& other_map,
                                      const LoopCloser& other) const {
  LoopReport report;
  const Timer timer;
  const PlaceView query{map, places_, keyframe};
  const auto verdicts = DetectInOtherMap(query, other_map, other.places_, options_);
  CountCandidates(verdicts, report);
  report.detect_ms = timer.ElapsedMs();
  Verify(query, verdicts, other_map, other.places_, report);
  return report;
}

void LoopCloser::Verify(const PlaceView& query, const std::vector<CandidateVerdict>& verdicts,
                        const Map& other_map, const PlaceIndex& other_places,
                        LoopReport& report) const {
  const Timer timer;
  for (const CandidateVerdict& verdict : verdicts) {
    if (static_cast<int>(report.attempts.size()) == options_.max_verified) break;
    if (verdict.rejection != CandidateRejection::kAccepted) continue;
    const KeyFrameId candidate(verdict.candidate.keyframe);
    PlaceAttempt attempt{{query.keyframe, candidate}, verdict.candidate.score, {}};
    attempt.match = VerifyPlace(query, {other_map, other_places, candidate}, options_.verification,
                                seed_ + query.keyframe.index());
    report.attempts.push_back(std::move(attempt));
    if (IsAccepted(report)) break;
  }
  report.verify_ms = timer.ElapsedMs();
}

std::vector<KeyFrameId> LoopCloser::FindSimilar(const FrameFeatures& features,
                                                const Map& map) const {
  return FindSimilarKeyFrames(features, map, places_, options_, options_.max_verified);
}

void LoopCloser::Absorb(const LoopCloser& other, int offset, const LoopEdge& merged_by,
                        KeyFrameId newest) {
  places_.Absorb(other.places_, offset);
  tree_.Absorb(other.tree_, offset);
  for (const LoopEdge& loop : other.loops_) {
    loops_.push_back(
        {KeyFrameId(loop.query.value + offset), KeyFrameId(loop.candidate.value + offset)});
  }
  loops_.push_back(merged_by);
  last_loop_ = newest;
  detector_.Reset();
  confirmation_.Reset();
  bundle_.GiveUp();
}

}  // namespace lift_slam
