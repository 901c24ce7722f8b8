#include "apps/run_report_data.h"

#include <fmt/format.h>

#include <algorithm>

#include "lift_slam/visualization/report_tables.h"
#include "lift_slam/visualization/time_summary.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

constexpr double kBytesPerMegabyte = 1e6;

std::string Count(std::size_t n) { return std::to_string(n); }
std::string Count(int n) { return std::to_string(n); }

ReportStatus StatusOf(RunStatus status) {
  if (status == RunStatus::kOk) return ReportStatus::kOk;
  return status == RunStatus::kPartial ? ReportStatus::kPartial : ReportStatus::kFailed;
}

const char* LabelOf(RunStatus status) {
  if (status == RunStatus::kOk) return "OK";
  return status == RunStatus::kPartial ? "PARTIAL" : "FAILED";
}

// Why a run with a map counts as partial or failed.
std::string Shortfall(const EvaluationResult& result) {
  const StatusThresholds& limits = result.options.status;
  const Coverage& coverage = result.coverage;
  if (result.status == RunStatus::kPartial) {
    return fmt::format(" OK needs {:.0f} %.", 100.0 * limits.min_ok_coverage);
  }
  if (result.status != RunStatus::kFailLost) return {};
  if (coverage.coverage < limits.min_partial_coverage) {
    return fmt::format(" Below {:.0f} % a run counts as lost.",
                       100.0 * limits.min_partial_coverage);
  }
  return fmt::format(" The camera was lost for the last {:.1f} s.", coverage.lost_at_end_s);
}

std::string Summary(const FinishedRun& finished) {
  const EvaluationResult& result = finished.evaluation.final_trajectory;
  const Coverage& coverage = result.coverage;
  std::string text;
  if (result.status == RunStatus::kFailInit) {
    text = fmt::format("No map could be started in {} frames, so no frame has a pose.",
                       coverage.frames_total);
  } else {
    text = fmt::format("The camera was tracked in {} of {} frames ({:.1f} %).", coverage.frames_ok,
                       coverage.frames_total, 100.0 * coverage.coverage);
    text += Shortfall(result);
  }
  if (result.ate_m) {
    text += fmt::format(" The path lies {} m off the ground truth (RMSE after alignment).",
                        FormatNumber(result.ate_m->rmse, 3));
  } else if (!finished.ground_truth.empty() && result.status != RunStatus::kFailInit) {
    text += " It could not be compared with the ground truth: " + result.no_errors_reason;
  }
  if (finished.run.interrupted) text += " The run was interrupted before the input ended.";
  return text;
}

// The most frequent reason for frames without a pose, where there is something to explain.
std::string Advice(const FinishedRun& finished) {
  if (finished.evaluation.final_trajectory.status == RunStatus::kOk) return {};
  for (const FrameRefusal refusal : RefusalsByCount(finished.run)) {
    if (refusal == FrameRefusal::kFirstFrame) continue;
    return fmt::format(
        "Most often ({} of {} frames without a pose): {}",
        finished.run.refusals[static_cast<std::size_t>(refusal)],
        finished.run.frames.size() -
            static_cast<std::size_t>(finished.evaluation.final_trajectory.coverage.frames_ok),
        Explain(refusal));
  }
  return {};
}

TimeSummary FrameTimes(const RunRecord& run) {
  std::vector<double> times_ms;
  for (const FrameRecord& frame : run.frames) times_ms.push_back(frame.extract_ms + frame.track_ms);
  return SummarizeTimes(std::move(times_ms));
}

double FramesPerSecond(const RunRecord& run) {
  return run.wall_time_s > 0.0 ? static_cast<double>(run.frames.size()) / run.wall_time_s : 0.0;
}

std::vector<ReportRow> KeyNumbers(const FinishedRun& finished) {
  const RunRecord& run = finished.run;
  const EvaluationResult& result = finished.evaluation.final_trajectory;
  std::vector<ReportRow> rows;
  if (result.ate_m) {
    rows.push_back({"Position error", FormatNumber(result.ate_m->rmse, 3), "m", "ATE, RMSE"});
  }
  rows.push_back(
      {"Coverage", fmt::format("{:.1f}", 100.0 * result.coverage.coverage), "%",
       fmt::format("{} of {} frames", result.coverage.frames_ok, result.coverage.frames_total)});
  rows.push_back({"Maps", Count(run.num_maps), "", ""});
  rows.push_back({"Loops closed", Count(run.loops_closed), "",
                  run.place_recognition_notice.empty() ? "" : "loop closing is off"});
  rows.push_back({"Keyframes", Count(run.keyframes.size()), "", ""});
  rows.push_back({"Map points", Count(run.points.size()), "", ""});
  rows.push_back({"Speed", fmt::format("{:.1f}", FramesPerSecond(run)), "fps", "whole run"});
  rows.push_back({"Per frame", fmt::format("{:.1f}", FrameTimes(run).median_ms), "ms",
                  run.num_cached_frames > 0 ? "median, with features from the cache"
                                            : "median, extract and track"});
  const double megabytes =
      static_cast<double>(finished.provenance.peak_memory_bytes) / kBytesPerMegabyte;
  rows.push_back({"Peak memory", fmt::format("{:.0f}", megabytes), "MB", ""});
  return rows;
}

void AddStatistics(const std::string& name, const std::optional<ErrorStatistics>& statistics,
                   const char* unit, const char* note, ReportTable& table) {
  if (!statistics) return;
  const ErrorStatistics& s = *statistics;
  table.rows.push_back({name + " RMSE", FormatNumber(s.rmse), unit, note});
  const std::pair<const char*, double> others[] = {
      {" mean", s.mean}, {" median", s.median}, {" smallest", s.min}, {" largest", s.max}};
  for (const auto& [which, value] : others) {
    table.rows.push_back({name + which, FormatNumber(value), unit, ""});
  }
}

ReportTable AccuracyTable(const FinishedRun& finished) {
  const RunEvaluation& evaluation = finished.evaluation;
  const EvaluationResult& result = evaluation.final_trajectory;
  ReportTable table{"Accuracy after alignment", {}};
  AddStatistics("ATE", result.ate_m, "m", "distance to the ground truth", table);
  if (evaluation.online_ate_m) {
    table.rows.push_back({"ATE RMSE, online", FormatNumber(evaluation.online_ate_m->rmse), "m",
                          "poses as first given"});
  }
  if (evaluation.keyframes_ate_m) {
    table.rows.push_back(
        {"ATE RMSE, keyframes", FormatNumber(evaluation.keyframes_ate_m->rmse), "m", ""});
  }
  if (result.ate_rotation_deg) {
    table.rows.push_back({"Rotation RMSE", FormatNumber(result.ate_rotation_deg->rmse), "deg", ""});
  }
  if (result.reference_from_estimate) {
    table.rows.push_back({"Alignment", std::string(Name(result.options.alignment)), "",
                          fmt::format("{} pairs", result.num_alignment_pairs)});
    table.rows.push_back(
        {"Scale", FormatNumber(result.reference_from_estimate->scale), "m/unit", ""});
  }
  return table;
}

ReportTable RelativeTable(const EvaluationResult& result) {
  ReportTable table{"Relative error", {}};
  if (result.kitti && result.kitti->all.num_segments > 0) {
    const SegmentErrors& all = result.kitti->all;
    table.rows.push_back({"Translation, t_rel", FormatNumber(all.translation_pct), "%",
                          fmt::format("{} segments of 100 to 800 m", all.num_segments)});
    table.rows.push_back(
        {"Rotation, r_rel", FormatNumber(100.0 * all.rotation_deg_per_m), "deg/100 m", ""});
  } else if (result.kitti) {
    table.rows.push_back({"Translation, t_rel", "n/a", "", "the path is shorter than 100 m"});
  }
  if (result.rpe) {
    const std::string step =
        fmt::format("over {} {}", FormatNumber(result.options.rpe.delta),
                    kRpeUnitNames[static_cast<std::size_t>(result.options.rpe.unit)]);
    table.rows.push_back(
        {"RPE translation RMSE", FormatNumber(result.rpe->translation_m.rmse), "m", step});
    table.rows.push_back(
        {"RPE rotation RMSE", FormatNumber(result.rpe->rotation_deg.rmse), "deg", step});
  }
  return table;
}

ReportTable CoverageTable(const FinishedRun& finished) {
  const EvaluationResult& result = finished.evaluation.final_trajectory;
  const Coverage& c = result.coverage;
  ReportTable table{"Coverage", {}};
  auto& rows = table.rows;
  rows.push_back({"Status", std::string(Name(result.status)), "", ""});
  rows.push_back(
      {"Frames with a pose", fmt::format("{} of {}", c.frames_ok, c.frames_total), "", ""});
  rows.push_back({"First pose", c.init_frame ? Count(*c.init_frame) : "none", "",
                  c.init_frame ? "frame, counted from 0" : ""});
  rows.push_back({"Longest run of poses", Count(c.longest_ok_run), "frames", ""});
  if (c.path_covered) {
    rows.push_back({"Path covered", fmt::format("{:.1f}", 100.0 * *c.path_covered), "%",
                    "of the ground truth's length"});
  }
  rows.push_back({"Times lost", Count(finished.run.lost_events), "", ""});
  rows.push_back({"Relocalisations", Count(finished.run.relocalisations), "", ""});
  rows.push_back({"Loops closed", Count(finished.run.loops_closed), "", ""});
  return table;
}

ReportTable SpeedTable(const FinishedRun& finished) {
  const TimeSummary t = FrameTimes(finished.run);
  ReportTable table{"Speed", {}};
  table.rows.push_back({"Whole run", fmt::format("{:.2f}", finished.run.wall_time_s), "s",
                        fmt::format("{:.1f} frames/s", FramesPerSecond(finished.run))});
  table.rows.push_back(
      {"Per frame, median", fmt::format("{:.1f}", t.median_ms), "ms", "extraction and tracking"});
  table.rows.push_back({"Per frame, 95 % below", fmt::format("{:.1f}", t.p95_ms), "ms", ""});
  return table;
}

// For people; "radial_tangential" and so on are Camera::ModelName.
const char* DistortionName(const Distortion& distortion) {
  if (std::holds_alternative<RadialTangential>(distortion)) return "radial-tangential distortion";
  if (std::holds_alternative<KannalaBrandt>(distortion)) return "Kannala-Brandt fisheye";
  if (std::holds_alternative<FieldOfView>(distortion)) return "field-of-view distortion";
  return "pinhole without distortion";
}

ReportTable ProvenanceTable(const FinishedRun& finished) {
  const Provenance& p = finished.provenance;
  ReportTable table;
  table.rows = {{"version", p.program_version, "", ""},
                {"git revision", p.git_revision, "", ""},
                {"date", p.date_utc, "", ""},
                {"processor", fmt::format("{}, {} threads", p.cpu_name, p.threads), "", ""},
                {"configuration SHA-256", p.config_sha256, "", ""}};
  const Camera& camera = finished.run.camera;
  table.rows.push_back(
      {"camera",
       fmt::format("{} x {} px, {}, fx {} fy {} cx {} cy {}", camera.pinhole.width,
                   camera.pinhole.height, DistortionName(camera.distortion),
                   FormatNumber(camera.pinhole.fx, 6), FormatNumber(camera.pinhole.fy, 6),
                   FormatNumber(camera.pinhole.cx, 6), FormatNumber(camera.pinhole.cy, 6)),
       "", camera.source});
  for (const auto& [name, value] : finished.settings) table.rows.push_back({name, value, "", ""});
  for (const std::string& warning : finished.warnings) {
    table.rows.push_back({"warning", warning, "", ""});
  }
  return table;
}

}  // namespace

ReportData MakeReportData(const FinishedRun& finished) {
  const EvaluationResult& result = finished.evaluation.final_trajectory;
  ReportData data;
  data.sequence =
      finished.dataset.empty() ? finished.sequence : finished.dataset + " " + finished.sequence;
  data.status = StatusOf(result.status);
  data.status_label = LabelOf(result.status);
  data.summary = Summary(finished);
  data.advice = Advice(finished);
  data.key_numbers = KeyNumbers(finished);
  data.tables = {AccuracyTable(finished), RelativeTable(result), CoverageTable(finished),
                 SpeedTable(finished)};
  data.ground_truth = finished.ground_truth;
  data.ground_truth_view = finished.ground_truth_view;
  data.truth_from_map = result.reference_from_estimate;
  for (const FrameError& error : result.frame_errors) {
    data.errors.push_back({error.timestamp_ns, error.position_m});
  }
  if (result.ate_m) data.ate_rmse_m = result.ate_m->rmse;
  data.provenance = ProvenanceTable(finished);
  data.configuration = finished.config_yaml;
  return data;
}

}  // namespace lift_slam
