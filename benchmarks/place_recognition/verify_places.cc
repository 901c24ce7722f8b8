// How well geometry tells places apart (docs/loop_closing.md): verifies each keyframe of a saved
// map with the candidates that words give, as loop closing does but without waiting for several
// keyframes in a row, and writes a row of CSV for each with the true distance and angle between
// both cameras.
//
// Usage: verify_places SEQUENCE MAP [--lift] [--set KEY=VALUE]...
//   SEQUENCE   that the map was made from, with ground truth
//   MAP        saved by `lift_slam run --save-map`, best with slam.loop_closing.enabled=false
//   --lift     the map is of LIFT features of the weights that ship; else of ORB's
#include <fmt/format.h>

#include <cstdio>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "apps/vocabulary_choice.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/loop_closing/loop_detector.h"
#include "lift_slam/map/map_file.h"
#include "lift_slam/slam/feature_options.h"
#include "lift_slam/slam/frame_preparer.h"
#include "lift_slam/slam/slam_options.h"
#include "lift_slam/util/config_file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

struct Arguments {
  std::string sequence, map;
  SlamOptions slam;
};

using Poses = std::map<std::int64_t, Rigid3d>;  // world_from_cam by frame

Poses TruePoses(const SequenceInfo& info) {
  if (!info.ground_truth || !info.ground_truth->by_index) {
    throw InputError("the sequence has no ground truth by frame (KITTI), expected one");
  }
  Poses poses;
  for (const TrajectoryPose& pose : info.ground_truth->poses) {
    poses[pose.frame_index] = pose.world_from_cam;
  }
  return poses;
}

class Verification {
 public:
  Verification(const Arguments& arguments, Poses poses,
               std::shared_ptr<const Vocabulary> vocabulary)
      : options_(arguments.slam.loop_closing),
        poses_(std::move(poses)),
        vocabulary_(std::move(vocabulary)) {
    options_.candidates.min_consistent_keyframes = 1;
  }

  // With the keyframes before in the same map, and with those of all earlier maps.
  void Verify(const Map& map) {
    LoopDetector detector(options_);
    PlaceIndex places(vocabulary_, options_.score);
    for (const KeyFrameId id : map.KeyFrameIds()) {
      places.Add(map.keyframe(id));
      const PlaceView query{map, places, id};
      VerifyCandidates(query, detector.Detect(query), map, places);
      for (const Earlier& earlier : earlier_) {
        VerifyCandidates(query, DetectInOtherMap(query, *earlier.map, earlier.places, options_),
                         *earlier.map, earlier.places);
      }
    }
    earlier_.push_back({&map, std::move(places)});
  }

 private:
  struct Earlier {
    const Map* map;
    PlaceIndex places;
  };

  void VerifyCandidates(const PlaceView& query, const std::vector<CandidateVerdict>& verdicts,
                        const Map& map, const PlaceIndex& places) const {
    int num_verified = 0;
    for (const CandidateVerdict& verdict : verdicts) {
      if (num_verified == options_.max_verified) break;
      if (verdict.rejection != CandidateRejection::kAccepted) continue;
      ++num_verified;
      const KeyFrameId candidate(verdict.candidate.keyframe);
      const PlaceMatch match = VerifyPlace(query, {map, places, candidate}, options_.verification,
                                           query.keyframe.index());
      PrintRow(query.map.keyframe(query.keyframe).frame_index, map.keyframe(candidate).frame_index,
               verdict.candidate.score, match);
    }
  }

  void PrintRow(std::int64_t query, std::int64_t candidate, double score,
                const PlaceMatch& match) const {
    const auto a = poses_.find(query), b = poses_.find(candidate);
    if (a == poses_.end() || b == poses_.end()) return;
    const double angle = RotationAngle(a->second.rotation * b->second.rotation.conjugate());
    fmt::print(
        "{},{},{:.3f},{:.2f},{},{:.4f},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{:.3f},{}\n",
        query, candidate, (a->second.translation - b->second.translation).norm(),
        angle * 180.0 / std::numbers::pi, Name(match.rejection), score, match.num_word_matches,
        match.num_ransac_inliers, match.num_inliers, match.num_projected, match.found_ratio,
        match.own_found_ratio, match.reverse_found_ratio, match.reverse_own_found_ratio,
        match.mutual_ratio, match.offset_ratio, match.num_confirming);
  }

  LoopClosingOptions options_;
  Poses poses_;
  std::shared_ptr<const Vocabulary> vocabulary_;
  std::vector<Earlier> earlier_;
};

void Run(const Arguments& arguments) {
  const auto sequence = OpenSequence(arguments.sequence, {});
  auto extractor = CreateFeatureExtractor(arguments.slam.features);
  const DescriptorKind kind = extractor->descriptor_kind();
  const VocabularyChoice places = ChooseVocabulary(arguments.slam.loop_closing, kind);
  if (!places.vocabulary) throw InputError(places.notice);
  const FramePreparer preparer(*sequence->info().camera, std::move(extractor),
                               arguments.slam.alignment);
  const MapFile file = ReadMapFile(arguments.map, preparer.view(), kind);
  fmt::print(
      "query,other,distance_m,angle_deg,result,score,word_matches,ransac_inliers,inliers,projected,"
      "found_ratio,own_found_ratio,reverse_found_ratio,reverse_own_found_ratio,mutual_ratio,"
      "offset_ratio,confirming\n");
  Verification verification(arguments, TruePoses(sequence->info()), places.vocabulary);
  for (const StoredMap& stored : file.maps) verification.Verify(*stored.map);
}

Arguments ParseArguments(int argc, char** argv) {
  Arguments arguments;
  std::vector<std::string> overrides, names;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--lift") {
      arguments.slam.features.type = FeatureType::kLift;
    } else if (argument == "--set" && i + 1 < argc) {
      overrides.emplace_back(argv[++i]);
    } else {
      names.push_back(argument);
    }
  }
  if (names.size() != 2) {
    throw InputError("usage: verify_places SEQUENCE MAP [--lift] [--set KEY=VALUE]...");
  }
  ConfigureOptions({}, overrides, MakeOptionRoot(arguments.slam));
  arguments.sequence = names[0];
  arguments.map = names[1];
  return arguments;
}

}  // namespace
}  // namespace lift_slam

int main(int argc, char** argv) {
  try {
    lift_slam::Run(lift_slam::ParseArguments(argc, argv));
  } catch (const lift_slam::InputError& error) {
    std::cerr << "verify_places: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
