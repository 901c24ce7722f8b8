#include "lift_slam/slam/run_for_test.h"

#include <cstdlib>
#include <filesystem>
#include <opencv2/core.hpp>

#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/slam/feature_options.h"
#include "lift_slam/slam/slam_system.h"

namespace lift_slam {
namespace {

using NextFrame = std::function<std::optional<InputFrame>()>;

RunRecord RunFrames(const Camera& camera, const TestRunOptions& options, const NextFrame& next) {
  auto extractor = CreateFeatureExtractor(options.slam.features);
  const DescriptorKind kind = extractor->descriptor_kind();
  FramePreparer preparer(camera, std::move(extractor), options.slam.alignment,
                         options.slam.impulse_noise);
  SlamSystem system(camera, preparer.view(), options.slam, options.vocabulary);
  if (!options.load_maps.empty()) {
    system.LoadMaps(ReadMapFile(options.load_maps, preparer.view(), kind));
  }
  RunPipeline(
      options.mode,
      {[&] {
         auto frame = next();
         if (frame && options.change_frame) options.change_frame(*frame);
         return frame;
       },
       [&](const FrameRecord& frame) { return !options.frame_done || options.frame_done(frame); }},
      preparer, system);
  RunRecord record = system.Finish();
  if (!options.save_maps.empty()) {
    system.SaveMaps(options.save_maps, MakeMapFileInfo(*preparer.view(), kind, 0));
  }
  return record;
}

}  // namespace

SyntheticSequenceOptions SmallSequence(SyntheticPath path, int num_frames, double frame_rate_hz) {
  SyntheticSequenceOptions options;
  options.path = path;
  options.num_frames = num_frames;
  options.frame_rate_hz = frame_rate_hz;
  options.camera.pinhole = {375.0, 375.0, 239.5, 179.5, 480, 360};
  return options;
}

RunRecord RunSynthetic(const SyntheticSequenceOptions& sequence_options,
                       const TestRunOptions& options) {
  const SyntheticSequence sequence(sequence_options);
  int index = options.first_frame;
  return RunFrames(sequence.camera(), options, [&]() -> std::optional<InputFrame> {
    if (index == sequence.size()) return std::nullopt;
    InputFrame frame{index, sequence.TimestampNs(index), sequence.Render(index)};
    ++index;
    return frame;
  });
}

RunRecord RunSynthetic(const SyntheticSequenceOptions& sequence) {
  return RunSynthetic(sequence, TestRunOptions());
}

RunRecord RunSequence(std::unique_ptr<Sequence> sequence, const TestRunOptions& options) {
  return RunFrames(*sequence->info().camera, options, [&]() -> std::optional<InputFrame> {
    auto frame = sequence->Next();
    if (!frame) return std::nullopt;
    InputFrame input{frame->frame_index, frame->timestamp_ns, GrayImage()};
    if (frame->image) input.image = *frame->image;
    if (!frame->image) input.refusal = FrameRefusal::kImageUnreadable;
    return input;
  });
}

Trajectory TrueTrajectory(const SyntheticSequenceOptions& options) {
  const SyntheticSequence sequence(options);
  Trajectory truth;
  for (int i = 0; i < sequence.size(); ++i) {
    truth.push_back({i, sequence.TimestampNs(i), sequence.WorldFromCam(i), PoseState::kOk});
  }
  return truth;
}

std::shared_ptr<const Vocabulary> ShippedOrbVocabulary() {
  const char* source = std::getenv("LIFT_SLAM_SOURCE_DIR");
  const std::filesystem::path root = source != nullptr ? source : ".";
  return std::make_shared<Vocabulary>(root / "vocabularies" / "orb.vocabulary");
}

EvaluationResult Judge(const RunRecord& run, const Trajectory& truth) {
  return Evaluate(run.final_trajectory, truth, EvaluationOptions());
}

int CountOf(const RunRecord& run, FrameRefusal refusal) {
  return run.refusals[static_cast<std::size_t>(refusal)];
}

GrayImage PlainImage(const Camera& camera, int gray) {
  return GrayImage(cv::Mat(camera.pinhole.height, camera.pinhole.width, CV_8UC1, gray));
}

bool SamePoses(const Trajectory& a, const Trajectory& b) {
  return std::ranges::equal(a, b, [](const TrajectoryPose& p, const TrajectoryPose& q) {
    return p.frame_index == q.frame_index && p.timestamp_ns == q.timestamp_ns &&
           p.state == q.state && p.world_from_cam.translation == q.world_from_cam.translation &&
           p.world_from_cam.rotation.coeffs() == q.world_from_cam.rotation.coeffs();
  });
}

}  // namespace lift_slam
