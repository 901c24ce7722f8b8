#include "lift_slam/nn/executor.h"

#include <cmath>

#include "lift_slam/nn/onednn_backend.h"
#include "lift_slam/nn/reference_backend.h"
#include "lift_slam/nn/reference_layers.h"
#include "lift_slam/util/check.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam::nn {

Executor::Executor(const Network& network, const Shape& input, const ExecutorOptions& options,
                   PrecisionChoice precision)
    : input_shape_(input),
      output_shape_(OutputShape(network, input)),
      input_mean_(options.input_mean),
      input_scale_(options.input_scale),
      precision_(std::move(precision)) {
  LIFT_SLAM_CHECK(input.n == 1, "an executor is made for the shape of one sample, not {}",
                  ToString(input));
  LIFT_SLAM_CHECK(options.batch >= 1 && options.input_scale != 0.0F, "batch {}, input scale {}",
                  options.batch, options.input_scale);
}

template <class T>
std::span<const float> Executor::RunTyped(std::span<const T> samples) {
  const std::size_t sample_size = input_shape_.sample_size();
  LIFT_SLAM_CHECK(samples.size() % sample_size == 0, "{} values for samples of shape {}",
                  samples.size(), ToString(input_shape_));
  const auto count = samples.size() / sample_size;
  const std::size_t output_size = count * output_shape_.sample_size();
  if (output_.size() < output_size) output_.resize(output_size);
  const ReadSamples read = [&](int first, int number, float* destination) {
    const T* source = samples.data() + static_cast<std::size_t>(first) * sample_size;
    const std::size_t size = static_cast<std::size_t>(number) * sample_size;
    for (std::size_t i = 0; i < size; ++i) {
      destination[i] = (static_cast<float>(source[i]) - input_mean_) / input_scale_;
    }
  };
  Compute(read, static_cast<int>(count), output_.data());
  return {output_.data(), output_size};
}

std::span<const float> Executor::Run(std::span<const float> samples) { return RunTyped(samples); }
std::span<const float> Executor::Run(std::span<const std::uint8_t> samples) {
  return RunTyped(samples);
}

std::unique_ptr<Executor> MakeExecutor(const Network& network, const Shape& input,
                                       const ExecutorOptions& options,
                                       std::shared_ptr<WorkerTeam> team) {
  if (team == nullptr) team = std::make_shared<WorkerTeam>(1);
  if (options.backend == Backend::kReference) {
    return MakeReferenceExecutor(network, input, options, std::move(team));
  }
  return MakeOneDnnExecutor(
      network, input, options,
      ChoosePrecision(options.precision, CpuFeatures(), !options.activation_ranges.empty()),
      std::move(team));
}

std::vector<float> MeasureActivationRanges(const Network& network, const Shape& input,
                                           const ExecutorOptions& options,
                                           std::span<const float> samples) {
  LIFT_SLAM_CHECK(samples.size() % input.sample_size() == 0, "{} values for samples of shape {}",
                  samples.size(), ToString(input));
  std::vector<float> ranges;
  for (std::size_t i = 0; i < samples.size(); i += input.sample_size()) {
    Tensor tensor(input, samples.subspan(i, input.sample_size()));
    for (float& v : tensor.values()) v = (v - options.input_mean) / options.input_scale;
    std::size_t index = 0;
    for (const Layer& layer : network) {
      if (std::holds_alternative<Convolution>(layer) ||
          std::holds_alternative<FullyConnected>(layer)) {
        if (ranges.size() <= index) ranges.push_back(0.0F);
        for (const float v : tensor.values()) ranges[index] = std::max(ranges[index], std::abs(v));
        ++index;
      }
      tensor = ApplyLayer(layer, tensor);
    }
  }
  return ranges;
}

}  // namespace lift_slam::nn
