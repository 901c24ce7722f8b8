#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/slam/pipeline.h"
#include "lift_slam/slam/slam_options.h"
#include "lift_slam/testing/synthetic_sequence.h"

// Whole runs of the pipeline, for the tests of this folder.
namespace lift_slam {

struct TestRunOptions {
  RunMode mode = RunMode::kSequential;
  SlamOptions slam;
  std::shared_ptr<const Vocabulary> vocabulary;  // null: no place is recognised
  std::filesystem::path load_maps, save_maps;    // files; empty: none
  int first_frame = 0;                           // of a synthetic sequence
  // Changes a frame before the pipeline sees it.
  std::function<void(InputFrame&)> change_frame;
  // As in PipelineCallbacks; nothing: run to the end.
  std::function<bool(const FrameRecord&)> frame_done;
};

// `options` with a camera of 480 x 360 pixels, which keeps the tests quick.
SyntheticSequenceOptions SmallSequence(SyntheticPath path, int num_frames, double frame_rate_hz);

RunRecord RunSynthetic(const SyntheticSequenceOptions& sequence, const TestRunOptions& options);
RunRecord RunSynthetic(const SyntheticSequenceOptions& sequence);  // default options
// Runs a sequence of a dataset to its end, in threads.
RunRecord RunSequence(std::unique_ptr<Sequence> sequence, const TestRunOptions& options);

Trajectory TrueTrajectory(const SyntheticSequenceOptions& sequence);
// The one shipped for ORB; the test's environment says where.
std::shared_ptr<const Vocabulary> ShippedOrbVocabulary();

// The final trajectory against the truth, which may be empty.
EvaluationResult Judge(const RunRecord& run, const Trajectory& truth);

int CountOf(const RunRecord& run, FrameRefusal refusal);
// An image of one grey value, of the camera's size.
GrayImage PlainImage(const Camera& camera, int gray);
// Equal to the last bit.
bool SamePoses(const Trajectory& a, const Trajectory& b);

}  // namespace lift_slam
