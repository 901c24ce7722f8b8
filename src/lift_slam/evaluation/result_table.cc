#include "lift_slam/evaluation/result_table.h"

#include <fmt/format.h>

#include "lift_slam/evaluation/evaluate.h"

namespace lift_slam {
namespace {

std::string CountOrUnknown(const std::optional<int>& count) {
  return count ? std::to_string(*count) : "n/a";
}

std::string FormatStatus(const EvaluationResult& result) {
  const Coverage& coverage = result.coverage;
  const std::string path =
      coverage.path_covered ? fmt::format("{:.1f}", 100.0 * *coverage.path_covered) : "n/a";
  return fmt::format(
      "{:<10} {:>11} {:>16} {:>16} {:>10} {:>11} {:>14} {:>5}\n"
      "{:<10} {:>11.1f} {:>16} {:>16} {:>10} {:>11} {:>14} {:>5}\n",
      "status", "coverage[%]", "path covered[%]", "frames ok/all", "init frame", "lost events",
      "longest run", "maps", Name(result.status), 100.0 * coverage.coverage, path,
      fmt::format("{}/{}", coverage.frames_ok, coverage.frames_total),
      CountOrUnknown(coverage.init_frame), coverage.lost_events, coverage.longest_ok_run,
      CountOrUnknown(coverage.maps));
}

std::string FormatSettings(const EvaluationResult& result) {
  const Association& association = result.association;
  const bool by_time = association.method == AssociationMethod::kTime;
  std::string text =
      fmt::format("pairs by {}: {}; without partner: {} estimated, {} reference\n",
                  by_time ? "time" : "index", association.pairs.size(),
                  association.num_unpaired_estimate, association.num_unpaired_reference);
  if (by_time) {
    text += fmt::format("time difference: median {:.3f} ms, largest {:.3f} ms (limit {} ms{})\n",
                        1e3 * association.median_time_difference_s,
                        1e3 * association.max_time_difference_s,
                        result.options.association.max_time_difference_ms,
                        result.options.association.interpolate ? ", interpolated" : "");
  }
  if (result.coverage.source == FrameListSource::kInferred) {
    text += "input frames: inferred from the estimate's rate and the reference's time span\n";
  }
  text += fmt::format("alignment: {}", Name(result.options.alignment));
  if (result.reference_from_estimate) {
    text += fmt::format(", {} pairs, scale {:.9g}", result.num_alignment_pairs,
                        result.reference_from_estimate->scale);
  }
  return text +
         fmt::format("; reference positions: {}\n",
                     result.options.gt_frame == GroundTruthFrame::kCamera ? "camera" : "body");
}

std::string FormatErrorRow(std::string_view name, const ErrorStatistics& s) {
  return fmt::format("{:<28} {:>12.6f} {:>12.6f} {:>12.6f} {:>12.6f} {:>12.6f} {:>12.6f} {:>8}\n",
                     name, s.rmse, s.mean, s.median, s.std, s.min, s.max, s.count);
}

std::string FormatErrors(const EvaluationResult& result) {
  if (!result.ate_m) return fmt::format("no errors: {}\n", result.no_errors_reason);
  std::string text =
      fmt::format("{:<28} {:>12} {:>12} {:>12} {:>12} {:>12} {:>12} {:>8}\n", "error [unit]",
                  "rmse", "mean", "median", "std", "min", "max", "n");
  text += FormatErrorRow("ATE position [m]", *result.ate_m);
  text += FormatErrorRow("ATE rotation [deg]", *result.ate_rotation_deg);
  if (!result.rpe) return text;
  const std::string delta =
      fmt::format("per {} {}", result.options.rpe.delta,
                  result.options.rpe.unit == RpeUnit::kFrames ? "frame(s)" : "m");
  text += FormatErrorRow("RPE " + delta + " [m]", result.rpe->translation_m);
  return text + FormatErrorRow("RPE " + delta + " [deg]", result.rpe->rotation_deg);
}

std::string FormatScaleDrift(const ScaleDrift& drift) {
  return fmt::format("scale along the way: last / first tenth {:.4f}, largest / smallest {:.4f}\n",
                     drift.last_over_first, drift.largest_over_smallest);
}

std::string FormatSegmentRow(std::string_view length, const SegmentErrors& errors) {
  if (errors.num_segments == 0) {
    return fmt::format("{:<10} {:>9} {:>14} {:>16} {:>10}\n", length, "n/a", "n/a", "n/a", 0);
  }
  return fmt::format("{:<10} {:>9.4f} {:>14.6f} {:>16.4f} {:>10}\n", length, errors.translation_pct,
                     errors.rotation_deg_per_m, 100.0 * errors.rotation_deg_per_m,
                     errors.num_segments);
}

std::string FormatKitti(const KittiError& kitti) {
  std::string text = fmt::format("{:<10} {:>9} {:>14} {:>16} {:>10}\n", "length[m]", "t_rel[%]",
                                 "r_rel[deg/m]", "r_rel[deg/100m]", "segments");
  for (const KittiError::Length& length : kitti.by_length) {
    text += FormatSegmentRow(fmt::format("{:.0f}", length.length_m), length.errors);
  }
  return text + FormatSegmentRow("all", kitti.all);
}

}  // namespace

std::string FormatResult(const EvaluationResult& result) {
  std::string text = FormatStatus(result) + "\n" + FormatErrors(result) + "\n";
  if (result.scale_drift) text += FormatScaleDrift(*result.scale_drift) + "\n";
  if (result.kitti) text += FormatKitti(*result.kitti) + "\n";
  return text + FormatSettings(result);
}

}  // namespace lift_slam
