#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/image/image.h"
#include "lift_slam/nn/executor.h"
#include "lift_slam/nn/fft_filter_bank.h"

namespace lift_slam {

// How the detector's 25 x 25 filters are computed.
enum class DetectorMethod {
  kDirect,   // as a convolution, by the back-end
  kFourier,  // nn/fft_filter_bank.h: the same to within rounding, several times faster
};
inline constexpr std::string_view kDetectorMethodNames[] = {"direct", "fourier"};

struct LiftNetworkOptions {
  nn::Backend backend = nn::Backend::kOneDnn;
  // Of the descriptor and the orientation; the detector computes in float32.
  nn::Precision precision = nn::Precision::kFloat32;
  DetectorMethod detector = DetectorMethod::kFourier;
  int num_threads = 1;  // that the three networks share, the caller included
};

// Scores of the pixels of an image that have all 12 neighbours on each side: row 0, column 0 is
// pixel (12, 12). Width and height are 0 when the image is too small.
struct ScoreMap {
  int width = 0, height = 0;
  std::span<const float> scores;  // row by row; until the next call
};

// The three networks of LIFT, ready to run. Patches are 64 x 64 grey values, one after the other,
// any number. One caller at a time; results stay until the next call of the same function. The same
// bytes for any number of threads.
class LiftNetworks {
 public:
  LiftNetworks(const LiftWeights& weights, const LiftNetworkOptions& options);
  ~LiftNetworks();

  // 128 values a patch, not normalised.
  std::span<const float> DescribePatches(std::span<const std::uint8_t> patches);
  std::span<const float> DescribePatches(std::span<const float> patches);

  bool has_orientation() const { return orientation_ != nullptr; }
  // Radians in (-pi, pi], x right, y down: atan2 of the second output and the first. CheckError
  // without an orientation network.
  std::span<const float> OrientPatches(std::span<const std::uint8_t> patches);

  // Higher is more of a keypoint. With the direct method memory is kept for every size of image
  // seen.
  ScoreMap DetectorScores(const GrayImage& image);

  // What the descriptor really uses, and why it is not what was asked for.
  const nn::PrecisionChoice& precision() const { return descriptor_->precision(); }
  // The threads of the networks, for work between their calls.
  nn::WorkerTeam& team() { return *team_; }

 private:
  nn::Executor& DetectorFor(int width, int height);
  ScoreMap DirectScores(const GrayImage& image);

  LiftNetworkOptions options_;
  nn::Network detector_layers_;
  InputNormalization detector_input_;
  std::shared_ptr<nn::WorkerTeam> team_;
  std::unique_ptr<nn::Executor> descriptor_, orientation_;
  std::map<std::pair<int, int>, std::unique_ptr<nn::Executor>> detectors_;  // by width and height
  std::unique_ptr<nn::FftFilterBank> filter_bank_;
  std::vector<std::uint8_t> pixels_;
  std::vector<float> scores_, angles_;
};

// What int8 needs to know (LiftWeights::descriptor_ranges), measured on typical patches: a few
// hundred do. By the reference back-end, about 0.1 s a patch.
std::vector<float> MeasureDescriptorRanges(const LiftWeights& weights,
                                           std::span<const std::uint8_t> patches);

// The angle of one patch from the orientation network's two values (divided by the larger and
// kept away from zero, as the authors do, so that (0, 0) has an angle too).
float LiftAngle(float first, float second);

}  // namespace lift_slam
