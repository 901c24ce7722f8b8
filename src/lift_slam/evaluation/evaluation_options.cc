#include "lift_slam/evaluation/evaluation_options.h"

#include <fmt/format.h>

#include <cmath>

#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// Keeps the candidate pairs of a 200 Hz reference within memory.
constexpr double kLargestTimeDifferenceMs = 10'000.0;
constexpr double kLargestOffsetS = 4e9;  // a century: seconds since 1970 may be absent in one file

void Require(bool condition, std::string_view name, double value, std::string_view expected) {
  if (!condition) throw InputError(fmt::format("{} is {}, expected {}", name, value, expected));
}

}  // namespace

void AssociationOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("method", method, kAssociationMethodNames, "pairs by frame index or by time");
  visitor.Field("max_time_difference_ms", max_time_difference_ms,
                "poses further apart are no pair; 10 for EuRoC, 20 for TUM RGB-D");
  visitor.Field("offset_s", offset_s, "added to the timestamps of the estimate");
  visitor.Field("interpolate", interpolate, "interpolate the denser trajectory");
}

void RpeOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("delta", delta, "distance between the poses of a pair, in unit");
  visitor.Field("unit", unit, kRpeUnitNames, "unit of delta");
  visitor.Field("pairs", pairs, kRpePairsNames, "all pairs, or those that do not overlap");
  visitor.Field("path_source", path_source, kRpePathSourceNames,
                "whose path is measured in metres");
}

void StatusThresholds::Visit(OptionVisitor& visitor) {
  visitor.Field("min_ok_coverage", min_ok_coverage,
                "share of frames with a pose for status OK; below: PARTIAL");
  visitor.Field("min_partial_coverage", min_partial_coverage,
                "share of frames with a pose for PARTIAL; below: FAIL_LOST");
  visitor.Field("max_lost_at_end_s", max_lost_at_end_s,
                "longest time lost at the end that is no failure");
}

void EvaluationOptions::Visit(OptionVisitor& visitor) {
  visitor.Group("association", association, "pairing of estimated and reference poses");
  visitor.Field("alignment", alignment, kAlignmentModeNames,
                "how the estimate is laid over the reference");
  visitor.Field("align_first", align_first, "align with the first so many pairs; 0: all");
  visitor.Group("rpe", rpe, "relative pose error");
  visitor.Group("status", status, "limits between OK, PARTIAL and FAIL_LOST");
  visitor.Field("gt_frame", gt_frame, kGroundTruthFrameNames,
                "frame of the reference positions: camera, or body (IMU) as in the EuRoC files");
}

void EvaluationOptions::Check() const {
  const double difference = association.max_time_difference_ms;
  Require(difference >= 0.0 && difference <= kLargestTimeDifferenceMs, "max_time_difference_ms",
          difference, fmt::format("0 to {}", kLargestTimeDifferenceMs));
  Require(std::abs(association.offset_s) <= kLargestOffsetS, "offset_s", association.offset_s,
          fmt::format("at most {} either way", kLargestOffsetS));
  Require(align_first == 0 || align_first >= 3, "align_first", align_first, "0 (all) or 3 or more");
  Require(rpe.delta > 0.0 && std::isfinite(rpe.delta), "rpe.delta", rpe.delta, "more than 0");
  Require(rpe.unit == RpeUnit::kMetres || rpe.delta == std::floor(rpe.delta), "rpe.delta",
          rpe.delta, "a whole number of frames");
  Require(status.min_partial_coverage >= 0.0 && status.min_partial_coverage <= 1.0,
          "status.min_partial_coverage", status.min_partial_coverage, "0 to 1");
  Require(status.min_ok_coverage >= status.min_partial_coverage && status.min_ok_coverage <= 1.0,
          "status.min_ok_coverage", status.min_ok_coverage, "min_partial_coverage to 1");
  Require(status.max_lost_at_end_s >= 0.0, "status.max_lost_at_end_s", status.max_lost_at_end_s,
          "0 or more");
  Require(frames_total >= 0, "frames_total", frames_total, "0 (unknown) or more");
}

}  // namespace lift_slam
