#include "lift_slam/slam/map_collection.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "lift_slam/util/check.h"
#include "lift_slam/util/timer.h"

namespace lift_slam {

MapCollection::MapCollection(const SlamOptions& options,
                             std::shared_ptr<const Vocabulary> vocabulary, RunRecord& record)
    : options_(options), record_(record) {
  if (options.loop_closing.enabled) vocabulary_ = std::move(vocabulary);
}

int MapCollection::active_index() const {
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    if (maps_[i].get() == active_) return static_cast<int>(i);
  }
  return -1;
}

void MapCollection::Load(std::vector<StoredMap> stored) {
  LIFT_SLAM_CHECK(maps_.empty(), "{} maps before any is loaded", maps_.size());
  const Timer timer;
  for (StoredMap& map : stored) {
    maps_.push_back(std::make_unique<MapSession>(std::move(map), options_, vocabulary_));
  }
  record_.stage_times_ms["load.index"].push_back(timer.ElapsedMs());
}

void MapCollection::Store(const std::filesystem::path& path, const MapFileInfo& info) {
  std::vector<MapToStore> stored;
  for (const auto& map : maps_) {
    map->PrepareToStore(options_.final_bundle);
    stored.push_back(map->ToStore());
  }
  WriteMapFile(path, info, stored);
}

void MapCollection::Begin(InitialMap initial, const GrayImage& image) {
  maps_.push_back(std::make_unique<MapSession>(std::move(initial), image, options_, vocabulary_));
  active_ = maps_.back().get();
}

void MapCollection::ThrowAwayActive() {
  LIFT_SLAM_CHECK(active_ != nullptr && active_ == maps_.back().get(),
                  "of {} maps the active one is not the youngest", maps_.size());
  const int index = active_index();
  for (FrameRecord& frame : record_.frames) {
    if (frame.map_index == index) frame.map_index = -1;
  }
  maps_.pop_back();
  active_ = nullptr;
  merge_claims_.clear();
}

std::optional<MapSession::Step> MapCollection::Relocalize(const PreparedFrame& prepared) {
  if (!vocabulary_ || !options_.loop_closing.relocalisation || !prepared.features) {
    return std::nullopt;
  }
  const Timer timer;
  std::optional<MapSession::Step> found;
  for (auto map = maps_.rbegin(); map != maps_.rend() && !found; ++map) {
    if (active_ != nullptr && map->get() != active_) continue;
    MapSession::Step step = (*map)->Relocalize(prepared);
    if (step.tracking.refusal != FrameRefusal::kNone) {
      ++record_.counters[fmt::format("relocalise.refused.{}", Name(step.tracking.refusal))];
      continue;
    }
    PlaceEvent event;
    event.kind = PlaceEventKind::kRelocalisation;
    event.frame_index = prepared.input.frame_index;
    event.other_frame_index = (*map)->FrameIndexOf(step.tracking.reference);
    event.num_inliers = step.tracking.num_inliers;
    record_.place_events.push_back(event);
    active_ = map->get();
    found = std::move(step);
  }
  record_.stage_times_ms["relocalise"].push_back(timer.ElapsedMs());
  return found;
}

void MapCollection::RecognizePlaces(const MapSession::Step& step) {
  if (!step.loop) return;
  RecordReport(*step.loop, *active_, PlaceEventKind::kLoop);
  record_.loops_closed += step.loop->closed() ? 1 : 0;
  if (!options_.loop_closing.merging) return;
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    if (maps_[i].get() == active_) continue;
    LoopReport report = active_->FindNewestIn(*maps_[i]);
    const bool is_found = !report.attempts.empty() &&
                          report.attempts.back().match.rejection == PlaceRejection::kAccepted;
    const bool is_confirmed = is_found && IsConfirmed(report.attempts.back(), *maps_[i]);
    if (is_found && !is_confirmed) {
      report.attempts.back().match.rejection = PlaceRejection::kNotRepeated;
    }
    RecordReport(report, *maps_[i], PlaceEventKind::kMerge);
    if (!is_confirmed) continue;
    MergeWith(i, report.attempts.back());
    return;
  }
}

bool MapCollection::IsConfirmed(const PlaceAttempt& attempt, const MapSession& other) {
  auto claims = std::ranges::find_if(merge_claims_, [&](const MergeClaims& c) {
    return c.active == active_ && c.other == &other;
  });
  if (claims == merge_claims_.end()) {
    merge_claims_.push_back(
        {active_, &other, LoopConfirmation(options_.loop_closing.confirmation)});
    claims = std::prev(merge_claims_.end());
  }
  return claims->confirmation.Confirms(attempt.edge.query, attempt.match.query_from_candidate_world,
                                       active_->map());
}

void MapCollection::RecordReport(const LoopReport& report, const MapSession& other,
                                 PlaceEventKind kind) {
  const std::string stage = kind == PlaceEventKind::kLoop ? "loop" : "merge";
  for (std::size_t i = 1; i < report.candidates.size(); ++i) {
    if (report.candidates[i] == 0) continue;
    record_.counters[fmt::format("{}.candidates.{}", stage,
                                 Name(static_cast<CandidateRejection>(i)))] += report.candidates[i];
  }
  for (const PlaceAttempt& attempt : report.attempts) {
    const PlaceMatch& match = attempt.match;
    const bool is_accepted = match.rejection == PlaceRejection::kAccepted;
    ++record_.counters[is_accepted ? stage + ".accepted"
                                   : fmt::format("{}.rejected.{}", stage, Name(match.rejection))];
    PlaceEvent event;
    event.kind = kind;
    event.rejection = match.rejection;
    event.frame_index = active_->FrameIndexOf(attempt.edge.query);
    event.other_frame_index = other.FrameIndexOf(attempt.edge.candidate);
    event.score = attempt.score;
    event.num_word_matches = match.num_word_matches;
    event.num_inliers = match.num_inliers;
    event.num_projected = match.num_projected;
    event.found_ratio = match.found_ratio;
    event.own_found_ratio = match.own_found_ratio;
    event.mutual_ratio = match.mutual_ratio;
    event.offset_ratio = match.offset_ratio;
    event.num_confirming = match.num_confirming;
    if (is_accepted) {
      event.scale = report.correction
                        ? report.correction->scale_of_keyframe[attempt.edge.query.index()]
                        : 1.0 / match.query_from_candidate_world.scale;
    }
    record_.place_events.push_back(event);
  }
  auto& times = record_.stage_times_ms;
  times[stage + ".detect"].push_back(report.detect_ms);
  if (!report.attempts.empty()) times[stage + ".verify"].push_back(report.verify_ms);
  if (report.bundle) {
    times[stage + ".bundle"].push_back(report.bundle->solve_ms);
    times[stage + ".bundle_wait"].push_back(report.bundle->wait_ms);
    times[stage + ".bundle_merge"].push_back(report.bundle->merge_ms);
    ++record_.counters[stage + ".bundles_merged"];
  }
  if (!report.correction) return;
  times[stage + ".graph"].push_back(report.correction->graph_ms);
  times[stage + ".fuse"].push_back(report.correction->fusion_ms);
  record_.counters[stage + ".points_merged"] += report.correction->fused.points_merged;
}

void MapCollection::MergeWith(std::size_t other, const PlaceAttempt& attempt) {
  const Timer timer;
  const auto active = static_cast<std::size_t>(active_index());
  const std::size_t older = std::min(active, other), younger = std::max(active, other);
  const FusionCounts fused =
      maps_[older]->Absorb(std::move(*maps_[younger]), attempt,
                           active == older ? MapSession::MergeSide::kQueryIsMine
                                           : MapSession::MergeSide::kQueryIsOthers);
  active_ = maps_[older].get();
  merge_claims_.clear();
  maps_.erase(maps_.begin() + static_cast<std::ptrdiff_t>(younger));
  RenumberFrames(static_cast<int>(younger), static_cast<int>(older));
  ++record_.maps_merged;
  record_.counters["merge.points_merged"] += fused.points_merged;
  record_.stage_times_ms["merge.join"].push_back(timer.ElapsedMs());
}

void MapCollection::RenumberFrames(int younger, int older) {
  for (FrameRecord& frame : record_.frames) {
    if (frame.map_index == younger) {
      frame.map_index = older;
    } else if (frame.map_index > younger) {
      --frame.map_index;
    }
  }
}

void MapCollection::AdjustAll() {
  for (const auto& map : maps_) {
    if (map->map().num_keyframes() < 3 || !map->is_of_this_run()) continue;
    map->AdjustFinally(options_.final_bundle, options_.self_calibration, record_.stage_times_ms);
  }
}

}  // namespace lift_slam
