#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lift_slam/nn/layers.h"
#include "lift_slam/nn/precision.h"
#include "lift_slam/nn/worker_team.h"

namespace lift_slam::nn {

enum class Backend {
  kReference,  // plain loops, float32: slow, and right by inspection
  kOneDnn,     // as fast as the machine allows
};
inline constexpr std::string_view kBackendNames[] = {"reference", "onednn"};

// "oneDNN 2.7.3", the library that is loaded: for keys of kept results.
std::string NetworkLibraryVersion();

struct ExecutorOptions {
  Backend backend = Backend::kOneDnn;
  Precision precision = Precision::kFloat32;
  // Samples that one thread takes through the network at a time: weights are read once for them,
  // and their activations must fit into the second-level cache. 16 is best for LIFT's descriptor.
  int batch = 16;
  // Every input value v becomes (v - input_mean) / input_scale before the first layer.
  float input_mean = 0.0F;
  float input_scale = 1.0F;
  // For int8: largest absolute input of each convolution and fully connected layer, in their order
  // (MeasureActivationRanges). Without them int8 falls back.
  std::vector<float> activation_ranges = {};
};

// A network made ready for samples of one shape. One caller at a time; executors that share a team
// are called in turns.
class Executor {
 public:
  virtual ~Executor() = default;
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  const Shape& input_shape() const { return input_shape_; }    // of one sample, n = 1
  const Shape& output_shape() const { return output_shape_; }  // of one sample, n = 1
  // What is really used, and why it is not what was asked for.
  const PrecisionChoice& precision() const { return precision_; }

  // Any whole number of samples, one after the other, each in C, H, W order. The result (the same
  // number of samples) stays until the next Run. No tensor memory is allocated unless there are
  // more samples than ever before. The same bytes for any number of threads.
  std::span<const float> Run(std::span<const float> samples);
  std::span<const float> Run(std::span<const std::uint8_t> samples);

 protected:
  // Writes samples [first, first + count), scaled, to the destination.
  using ReadSamples = std::function<void(int first, int count, float* destination)>;

  Executor(const Network& network, const Shape& input, const ExecutorOptions& options,
           PrecisionChoice precision);
  virtual void Compute(const ReadSamples& read, int count, float* output) = 0;

 private:
  template <class T>
  std::span<const float> RunTyped(std::span<const T> samples);

  Shape input_shape_, output_shape_;
  float input_mean_, input_scale_;
  PrecisionChoice precision_;
  AlignedVector<float> output_;
};

// CheckError when network and input shape do not fit together. Without a team the caller computes
// alone. The network is copied where it is needed.
std::unique_ptr<Executor> MakeExecutor(const Network& network, const Shape& input,
                                       const ExecutorOptions& options,
                                       std::shared_ptr<WorkerTeam> team = nullptr);

// Largest absolute input of each convolution and fully connected layer over these samples (scaled
// as the options say), by the reference back-end.
std::vector<float> MeasureActivationRanges(const Network& network, const Shape& input,
                                           const ExecutorOptions& options,
                                           std::span<const float> samples);

}  // namespace lift_slam::nn
