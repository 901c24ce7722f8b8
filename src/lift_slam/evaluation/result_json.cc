#include "lift_slam/evaluation/result_json.h"

#include <nlohmann/json.hpp>
#include <string>

#include "lift_slam/evaluation/evaluate.h"

namespace lift_slam {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
Json OrNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json OrNull(const std::optional<ErrorStatistics>& statistics) {
  return statistics ? ToJson(*statistics) : Json(nullptr);
}

Json AlignmentJson(const EvaluationResult& result) {
  Json json = {{"mode", Name(result.options.alignment)}};
  json["n"] = result.num_alignment_pairs;
  json["align_first"] = result.options.align_first;
  if (!result.reference_from_estimate) {
    json["s"] = json["R"] = json["t"] = nullptr;
    return json;
  }
  const Sim3d& sim3 = *result.reference_from_estimate;
  const Eigen::Matrix3d rotation = sim3.rotation.toRotationMatrix();
  json["s"] = sim3.scale;
  json["R"] = Json::array();
  for (Eigen::Index r = 0; r < 3; ++r) {
    json["R"].push_back({rotation(r, 0), rotation(r, 1), rotation(r, 2)});
  }
  json["t"] = {sim3.translation.x(), sim3.translation.y(), sim3.translation.z()};
  return json;
}

Json AssociationJson(const EvaluationResult& result) {
  const Association& association = result.association;
  const AssociationOptions& options = result.options.association;
  return {{"method", kAssociationMethodNames[static_cast<std::size_t>(association.method)]},
          {"pairs", association.pairs.size()},
          {"unpaired_estimate", association.num_unpaired_estimate},
          {"unpaired_reference", association.num_unpaired_reference},
          {"median_dt", association.median_time_difference_s},
          {"max_dt", association.max_time_difference_s},
          {"max_time_difference_ms", options.max_time_difference_ms},
          {"offset_s", options.offset_s},
          {"interpolate", options.interpolate}};
}

Json SegmentsJson(const SegmentErrors& errors) {
  Json json;
  const bool known = errors.num_segments > 0;
  json["t_rel_pct"] = known ? Json(errors.translation_pct) : Json(nullptr);
  json["r_rel_deg_per_m"] = known ? Json(errors.rotation_deg_per_m) : Json(nullptr);
  json["r_rel_deg_per_100m"] = known ? Json(100.0 * errors.rotation_deg_per_m) : Json(nullptr);
  json["segments"] = errors.num_segments;
  return json;
}

Json KittiJson(const KittiError& kitti) {
  Json json = SegmentsJson(kitti.all);
  json["per_length"] = Json::array();
  for (const KittiError::Length& length : kitti.by_length) {
    Json entry = {{"length_m", length.length_m}};
    entry.update(SegmentsJson(length.errors));
    json["per_length"].push_back(std::move(entry));
  }
  return json;
}

Json RpeJson(const EvaluationResult& result) {
  const RpeOptions& options = result.options.rpe;
  return {{"delta", options.delta},
          {"unit", kRpeUnitNames[static_cast<std::size_t>(options.unit)]},
          {"pairs", kRpePairsNames[static_cast<std::size_t>(options.pairs)]},
          {"path_source", kRpePathSourceNames[static_cast<std::size_t>(options.path_source)]},
          {"translation_m", ToJson(result.rpe->translation_m)},
          {"rotation_deg", ToJson(result.rpe->rotation_deg)}};
}

Json ScaleDriftJson(const ScaleDrift& drift) {
  return {{"last_over_first", drift.last_over_first},
          {"largest_over_smallest", drift.largest_over_smallest},
          {"scale_of_piece", drift.scale_of_piece}};
}

Json CoverageJson(const Coverage& coverage) {
  return {{"frames_total", coverage.frames_total},
          {"frames_total_source", Name(coverage.source)},
          {"frames_ok", coverage.frames_ok},
          {"coverage", coverage.coverage},
          {"init_frame", OrNull(coverage.init_frame)},
          {"lost_events", coverage.lost_events},
          {"longest_ok_run", coverage.longest_ok_run},
          {"lost_at_end_s", coverage.lost_at_end_s},
          {"path_covered", OrNull(coverage.path_covered)},
          {"maps", OrNull(coverage.maps)},
          {"relocalisations", OrNull(coverage.relocalisations)},
          {"loops_closed", OrNull(coverage.loops_closed)}};
}

}  // namespace

Json ToJson(const ErrorStatistics& statistics) {
  return {{"rmse", statistics.rmse}, {"mean", statistics.mean}, {"median", statistics.median},
          {"std", statistics.std},   {"min", statistics.min},   {"max", statistics.max},
          {"n", statistics.count}};
}

Json ToJson(const EvaluationResult& result) {
  const StatusThresholds& thresholds = result.options.status;
  Json json;
  json["dataset"] = result.dataset;
  json["sequence"] = result.sequence;
  json["mode"] = Name(result.kind);
  json["gt_frame"] = kGroundTruthFrameNames[static_cast<std::size_t>(result.options.gt_frame)];
  json["status"] = Name(result.status);
  json["alignment"] = AlignmentJson(result);
  json["association"] = AssociationJson(result);
  json["ate"] = OrNull(result.ate_m);
  json["ate_rotation_deg"] = OrNull(result.ate_rotation_deg);
  json["kitti"] = result.kitti ? KittiJson(*result.kitti) : Json(nullptr);
  json["rpe"] = result.rpe ? RpeJson(result) : Json(nullptr);
  json["scale_drift"] = result.scale_drift ? ScaleDriftJson(*result.scale_drift) : Json(nullptr);
  json["coverage"] = CoverageJson(result.coverage);
  json["thresholds"] = {{"min_ok_coverage", thresholds.min_ok_coverage},
                        {"min_partial_coverage", thresholds.min_partial_coverage},
                        {"max_lost_at_end_s", thresholds.max_lost_at_end_s}};
  if (!result.no_errors_reason.empty()) json["no_errors_reason"] = result.no_errors_reason;
  return json;
}

}  // namespace lift_slam
