#include "lift_slam/features/lift/lift_networks.h"

#include <algorithm>
#include <cmath>

#include "lift_slam/features/lift/lift_weights_topology.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr nn::Shape kPatch{1, 1, kLiftPatchSize, kLiftPatchSize};

nn::ExecutorOptions MakeOptions(const LiftNetworkOptions& options,
                                const InputNormalization& input) {
  nn::ExecutorOptions result;
  result.backend = options.backend;
  result.precision = options.precision;
  result.input_mean = input.mean;
  result.input_scale = input.scale;
  return result;
}

std::unique_ptr<nn::Executor> MakeDescriptor(const LiftWeights& weights,
                                             const LiftNetworkOptions& options,
                                             const std::shared_ptr<nn::WorkerTeam>& team) {
  nn::ExecutorOptions executor = MakeOptions(options, weights.descriptor_input);
  executor.activation_ranges = weights.descriptor_ranges;
  return nn::MakeExecutor(weights.descriptor, kPatch, executor, team);
}

// Nearly all of it is one matrix of 2 million weights, which are worth reading for many patches.
// It has no ranges for int8, and falls back to bfloat16.
std::unique_ptr<nn::Executor> MakeOrientation(const LiftWeights& weights,
                                              const LiftNetworkOptions& options,
                                              const std::shared_ptr<nn::WorkerTeam>& team) {
  if (!weights.orientation) return nullptr;
  nn::ExecutorOptions executor = MakeOptions(options, weights.orientation_input);
  executor.batch = 64;
  return nn::MakeExecutor(*weights.orientation, kPatch, executor, team);
}

}  // namespace

LiftNetworks::LiftNetworks(const LiftWeights& weights, const LiftNetworkOptions& options)
    : options_(options),
      detector_layers_(weights.detector),
      detector_input_(weights.detector_input),
      team_(std::make_shared<nn::WorkerTeam>(options.num_threads)),
      descriptor_(MakeDescriptor(weights, options, team_)),
      orientation_(MakeOrientation(weights, options, team_)) {
  if (options.detector == DetectorMethod::kFourier) {
    filter_bank_ =
        std::make_unique<nn::FftFilterBank>(std::get<nn::Convolution>(weights.detector.front()),
                                            detector_input_.mean, detector_input_.scale, team_);
  }
}

LiftNetworks::~LiftNetworks() = default;

std::span<const float> LiftNetworks::DescribePatches(std::span<const std::uint8_t> patches) {
  return descriptor_->Run(patches);
}

std::span<const float> LiftNetworks::DescribePatches(std::span<const float> patches) {
  return descriptor_->Run(patches);
}

std::span<const float> LiftNetworks::OrientPatches(std::span<const std::uint8_t> patches) {
  LIFT_SLAM_CHECK(has_orientation(), "these weights have no orientation network");
  const std::span<const float> outputs = orientation_->Run(patches);
  angles_.resize(outputs.size() / 2);
  for (std::size_t i = 0; i < angles_.size(); ++i) {
    angles_[i] = LiftAngle(outputs[2 * i], outputs[2 * i + 1]);
  }
  return angles_;
}

nn::Executor& LiftNetworks::DetectorFor(int width, int height) {
  std::unique_ptr<nn::Executor>& detector = detectors_[{width, height}];
  if (detector == nullptr) {
    nn::ExecutorOptions executor = MakeOptions(options_, detector_input_);
    executor.precision = nn::Precision::kFloat32;
    executor.batch = 1;
    detector = nn::MakeExecutor(detector_layers_, {1, 1, height, width}, executor, team_);
  }
  return *detector;
}

ScoreMap LiftNetworks::DetectorScores(const GrayImage& image) {
  const int width = image.width() - 2 * kLiftDetectorBorder;
  const int height = image.height() - 2 * kLiftDetectorBorder;
  if (std::min(width, height) <= 0) return {};
  if (options_.detector == DetectorMethod::kDirect) return DirectScores(image);
  const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (scores_.size() < size) scores_.resize(size);
  filter_bank_->Run({.pixels = image.row(0),
                     .width = image.width(),
                     .height = image.height(),
                     .stride = image.row(1) - image.row(0)},
                    scores_.data());
  return {width, height, std::span(scores_).first(size)};
}

ScoreMap LiftNetworks::DirectScores(const GrayImage& image) {
  const auto width = static_cast<std::size_t>(image.width());
  pixels_.resize(width * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    std::copy_n(image.row(y), width, pixels_.data() + static_cast<std::size_t>(y) * width);
  }
  nn::Executor& detector = DetectorFor(image.width(), image.height());
  const nn::Shape& shape = detector.output_shape();
  return {shape.w, shape.h, detector.Run(std::span<const std::uint8_t>(pixels_))};
}

std::vector<float> MeasureDescriptorRanges(const LiftWeights& weights,
                                           std::span<const std::uint8_t> patches) {
  const std::vector<float> samples(patches.begin(), patches.end());
  return nn::MeasureActivationRanges(weights.descriptor, kPatch,
                                     MakeOptions({}, weights.descriptor_input), samples);
}

float LiftAngle(float first, float second) {
  constexpr float kTiny = 1e-10F, kAwayFromZero = 1e-3F;
  const float larger = std::max({std::abs(first), std::abs(second), kTiny});
  const auto away = [&](float v) { return v / larger + (v >= 0 ? kAwayFromZero : -kAwayFromZero); };
  return std::atan2(away(second), away(first));
}

}  // namespace lift_slam
