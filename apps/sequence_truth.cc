#include "apps/sequence_truth.h"

#include <algorithm>

namespace lift_slam {

SequenceTruth TruthOf(const SequenceInfo& info, EvaluationOptions options) {
  if (info.format == SequenceFormat::kEuroc) {
    options.association.max_time_difference_ms =
        std::min(options.association.max_time_difference_ms, kEurocMaxTimeDifferenceMs);
  }
  const bool is_of_body = options.gt_frame == GroundTruthFrame::kBody && info.ground_truth &&
                          info.ground_truth->body_poses;
  options.gt_frame = is_of_body ? GroundTruthFrame::kBody : GroundTruthFrame::kCamera;
  if (!info.ground_truth) return {{}, options};
  const GroundTruth& truth = *info.ground_truth;
  if (options.association.method == AssociationMethod::kAuto) {
    options.association.method =
        truth.by_index ? AssociationMethod::kIndex : AssociationMethod::kTime;
  }
  return {is_of_body ? *truth.body_poses : truth.poses, options};
}

}  // namespace lift_slam
