#pragma once

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/evaluation/evaluation_options.h"

namespace lift_slam {

// What a run over a sequence is judged by.
struct SequenceTruth {
  Trajectory poses;  // in the frame of options.gt_frame; empty: there is no ground truth
  EvaluationOptions options;
};

// Options that leave the pairing open get the one that fits the sequence's truth, EuRoC's limit of
// time is never exceeded, and where there are no poses of the body those of the camera are taken
// and named so.
SequenceTruth TruthOf(const SequenceInfo& info, EvaluationOptions options);

}  // namespace lift_slam
