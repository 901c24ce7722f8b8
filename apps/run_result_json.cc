#include "apps/run_result_json.h"

#include <nlohmann/json.hpp>

#include "lift_slam/evaluation/result_json.h"
#include "lift_slam/visualization/time_summary.h"

namespace lift_slam {
namespace {

using Json = nlohmann::ordered_json;

Json StatisticsOrNull(const std::optional<ErrorStatistics>& statistics) {
  return statistics ? ToJson(*statistics) : Json(nullptr);
}

Json StatesJson(const RunRecord& run) {
  Json json;
  for (const TrackingState state :
       {TrackingState::kInitializing, TrackingState::kTracking, TrackingState::kLost}) {
    int count = 0;
    for (const FrameRecord& frame : run.frames) count += frame.state == state ? 1 : 0;
    json[std::string(Name(state))] = count;
  }
  return json;
}

Json RefusalsJson(const RunRecord& run) {
  Json json;
  for (std::size_t i = 1; i < run.refusals.size(); ++i) {
    json[std::string(Name(static_cast<FrameRefusal>(i)))] = run.refusals[i];
  }
  return json;
}

// By map: what self-calibration found the given calibration to be off by, and whether it was taken.
Json CalibrationsJson(const RunRecord& run) {
  Json json = Json::array();
  for (const SelfCalibrationReport& calibration : run.calibrations) {
    json.push_back({{"result", Name(calibration.refusal)},
                    {"focal_scale", calibration.estimate.focal_scale},
                    {"k1", calibration.estimate.k1}});
  }
  return json;
}

// Loops, merges and relocalisations, with what was refused and why.
Json PlacesJson(const RunRecord& run) {
  Json json = {{"notice", run.place_recognition_notice},
               {"loops_closed", run.loops_closed},
               {"maps_merged", run.maps_merged},
               {"relocalisations", run.relocalisations},
               {"events", Json::array()}};
  for (const PlaceEvent& event : run.place_events) {
    json["events"].push_back({{"kind", Name(event.kind)},
                              {"result", Name(event.rejection)},
                              {"frame", event.frame_index},
                              {"other_frame", event.other_frame_index},
                              {"score", event.score},
                              {"word_matches", event.num_word_matches},
                              {"inliers", event.num_inliers},
                              {"projected", event.num_projected},
                              {"found_ratio", event.found_ratio},
                              {"own_found_ratio", event.own_found_ratio},
                              {"mutual_ratio", event.mutual_ratio},
                              {"offset_ratio", event.offset_ratio},
                              {"confirming", event.num_confirming},
                              {"scale", event.scale}});
  }
  return json;
}

Json TimesJson(const std::vector<double>& times_ms) {
  const TimeSummary t = SummarizeTimes(times_ms);
  return {{"runs", t.runs},     {"median_ms", t.median_ms}, {"mean_ms", t.mean_ms},
          {"p95_ms", t.p95_ms}, {"max_ms", t.max_ms},       {"total_s", t.total_s}};
}

Json TimingJson(const RunRecord& run) {
  std::vector<double> frame_ms;
  for (const FrameRecord& frame : run.frames) frame_ms.push_back(frame.extract_ms + frame.track_ms);
  Json json = {{"wall_time_s", run.wall_time_s}};
  json["frames_per_s"] = run.wall_time_s > 0.0
                             ? Json(static_cast<double>(run.frames.size()) / run.wall_time_s)
                             : Json(nullptr);
  json["frames_from_cache"] = run.num_cached_frames;
  // Extraction and tracking, without mapping; no measure where features were found in a cache.
  json["frame_ms"] = run.num_cached_frames > 0 ? Json() : TimesJson(frame_ms);
  json["stages"] = Json::object();
  for (const auto& [stage, times] : run.stage_times_ms) json["stages"][stage] = TimesJson(times);
  return json;
}

Json ProvenanceJson(const FinishedRun& finished) {
  const Provenance& p = finished.provenance;
  Json json = {{"program_version", p.program_version},
               {"git_revision", p.git_revision},
               {"config_sha256", p.config_sha256},
               {"cpu_name", p.cpu_name},
               {"threads", p.threads},
               {"date_utc", p.date_utc}};
  for (const auto& [name, value] : finished.settings) json[name] = value;
  return json;
}

}  // namespace

std::string RunResultJson(const FinishedRun& finished) {
  const RunRecord& run = finished.run;
  Json json = ToJson(finished.evaluation.final_trajectory);
  json["dataset"] = finished.dataset;
  json["sequence"] = finished.sequence;
  json["configuration"] = finished.configuration;
  json["ate_online"] = StatisticsOrNull(finished.evaluation.online_ate_m);
  json["ate_keyframes"] = StatisticsOrNull(finished.evaluation.keyframes_ate_m);
  json["map"] = {
      {"maps", run.num_maps}, {"keyframes", run.keyframes.size()}, {"points", run.points.size()}};
  json["states"] = StatesJson(run);
  json["refusals"] = RefusalsJson(run);
  json["counters"] = run.counters;
  json["places"] = PlacesJson(run);
  json["self_calibrations"] = CalibrationsJson(run);
  json["timing"] = TimingJson(run);
  json["memory"] = {{"peak_bytes", finished.provenance.peak_memory_bytes}};
  json["interrupted"] = run.interrupted;
  json["warnings"] = finished.warnings;
  json["provenance"] = ProvenanceJson(finished);
  // Names from outside may hold bytes that are not UTF-8: those become U+FFFD.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lift_slam
