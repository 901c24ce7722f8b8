#include "lift_slam/features/lift/keypoint_detection.h"

#include "lift_slam/features/lift/patch_sampling.h"
#include "lift_slam/util/option_range.h"

namespace lift_slam {
namespace {

// Rows of a level that one thread takes at a time.
struct Strip {
  int level = 0, first_row = 0;
};
constexpr int kStripRows = 64;

std::vector<Strip> CutIntoStrips(std::span<const ScoreLevel> levels) {
  std::vector<Strip> strips;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    for (int y = 0; y < levels[i].shape.height; y += kStripRows) {
      strips.push_back({static_cast<int>(i), y});
    }
  }
  return strips;
}

std::vector<LiftKeypoint> FindInStrip(std::span<const ScoreLevel> levels, const Strip& strip,
                                      const LiftDetectorOptions& options) {
  std::vector<ScorePeak> peaks;
  AppendSpaceMaxima(levels[static_cast<std::size_t>(strip.level)], strip.level, strip.first_row,
                    strip.first_row + kStripRows, peaks);
  std::vector<LiftKeypoint> keypoints;
  for (const ScorePeak& peak : peaks) {
    if (!IsScaleMaximum(levels, peak, options.nms_levels, options.coordinates)) continue;
    const auto keypoint = RefinePeak(levels, peak, options.max_edge_ratio, options.coordinates);
    if (keypoint) keypoints.push_back(*keypoint);
  }
  return keypoints;
}

}  // namespace

void LiftDetectorOptions::Visit(OptionVisitor& visitor) {
  visitor.Field("first_level", first_level,
                "first level searched, sigma 2^(k / 5); 5 leaves the up-sampled octave out");
  visitor.Field("nms_levels", nms_levels, "levels above and below that a maximum must beat");
  visitor.Field("max_edge_ratio", max_edge_ratio,
                "largest ratio of the score's curvatures along two directions");
  visitor.Field("coordinates", coordinates, kLevelCoordinatesNames,
                "exact: by pixel centres; original: as the authors' code, half a pixel off");
}

void LiftDetectorOptions::Check() const {
  CheckOptionRange("lift.detector.first_level", first_level, 0, kLiftNumLevels - 5);
  CheckOptionRange("lift.detector.nms_levels", nms_levels, 1, 2);
  CheckOptionRange("lift.detector.max_edge_ratio", max_edge_ratio, 1.0, 1000.0);
}

std::vector<LiftKeypoint> FindKeypoints(std::span<const ScoreLevel> levels,
                                        const LiftDetectorOptions& options, nn::WorkerTeam& team) {
  const std::vector<Strip> strips = CutIntoStrips(levels);
  std::vector<std::vector<LiftKeypoint>> found(strips.size());
  team.ForEach(static_cast<int>(strips.size()), [&](int, int piece) {
    const auto i = static_cast<std::size_t>(piece);
    found[i] = FindInStrip(levels, strips[i], options);
  });
  std::vector<LiftKeypoint> keypoints;
  for (const auto& part : found) keypoints.insert(keypoints.end(), part.begin(), part.end());
  return keypoints;
}

KeypointDetector::KeypointDetector(const LiftDetectorOptions& options) : options_(options) {
  options_.Check();
}

std::vector<LiftKeypoint> KeypointDetector::Detect(const GrayImage& image, LiftNetworks& networks) {
  pyramid_.Compute(image, options_.first_level, networks);
  std::vector<LiftKeypoint> keypoints = FindKeypoints(pyramid_.levels(), options_, networks.team());
  std::erase_if(keypoints, [&](const LiftKeypoint& k) {
    return !LiesWithin(image, k.x, k.y, kLiftHalfWidthSigmas * k.sigma);
  });
  return keypoints;
}

}  // namespace lift_slam
