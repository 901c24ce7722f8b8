// SLAM over a sequence by the library: prints each frame's pose as it is found, and writes the
// final trajectory. Where the images come from a camera of your own, fill InputFrame yourself.
#include <cstdlib>
#include <iostream>
#include <memory>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/place_recognition/vocabulary.h"
#include "lift_slam/slam/feature_options.h"
#include "lift_slam/slam/frame_preparer.h"
#include "lift_slam/slam/slam_system.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/shipped_file.h"

namespace {

void Print(const lift_slam::FrameRecord& frame) {
  std::cout << frame.frame_index << ' ' << Name(frame.state);
  if (frame.world_from_cam) {
    std::cout << ' ' << frame.world_from_cam->translation.transpose();
  } else {
    std::cout << " (" << Explain(frame.refusal) << ')';
  }
  std::cout << '\n';
}

void Run(const std::string& source, const std::string& trajectory_file) {
  using namespace lift_slam;
  const std::unique_ptr<Sequence> sequence = OpenSequence(source);
  const Camera& camera = *sequence->info().camera;

  SlamOptions options;
  options.features.type = FeatureType::kOrb;  // or kLift
  FramePreparer preparer(camera, CreateFeatureExtractor(options.features), options.alignment,
                         options.impulse_noise);
  SlamSystem slam(camera, preparer.view(), options,
                  std::make_shared<Vocabulary>(ShippedFile("vocabularies/orb.vocabulary")));

  while (auto frame = sequence->Next()) {
    InputFrame input;
    input.frame_index = frame->frame_index;
    input.timestamp_ns = frame->timestamp_ns;
    if (frame->image) {
      input.image = *frame->image;
    } else {
      input.refusal = FrameRefusal::kImageUnreadable;
    }
    Print(slam.Process(preparer.Prepare(std::move(input))));
  }
  const RunRecord record = slam.Finish();
  WriteTrajectory(record.final_trajectory, TrajectoryFormat::kTum, trajectory_file);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: own_program SEQUENCE TRAJECTORY.tum\n";
    return EXIT_FAILURE;
  }
  try {
    Run(argv[1], argv[2]);
  } catch (const lift_slam::InputError& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
