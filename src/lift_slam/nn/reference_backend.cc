#include "lift_slam/nn/reference_backend.h"

#include "lift_slam/nn/reference_layers.h"

namespace lift_slam::nn {
namespace {

PrecisionChoice ReferencePrecision(Precision wanted) {
  if (wanted == Precision::kFloat32 || wanted == Precision::kAuto) return {};
  return {Precision::kFloat32, "the reference back-end computes in float32 only"};
}

class ReferenceExecutor : public Executor {
 public:
  ReferenceExecutor(const Network& network, const Shape& input, const ExecutorOptions& options,
                    std::shared_ptr<WorkerTeam> team)
      : Executor(network, input, options, ReferencePrecision(options.precision)),
        network_(network),
        team_(std::move(team)) {}

 private:
  void Compute(const ReadSamples& read, int count, float* output) override {
    team_->ForEach(count, [&](int, int sample) {
      Tensor input(input_shape());
      read(sample, 1, input.data());
      const Tensor result = ApplyNetwork(network_, input);
      std::copy(result.values().begin(), result.values().end(),
                output + static_cast<std::ptrdiff_t>(result.size()) * sample);
    });
  }

  Network network_;
  std::shared_ptr<WorkerTeam> team_;
};

}  // namespace

std::unique_ptr<Executor> MakeReferenceExecutor(const Network& network, const Shape& input,
                                                const ExecutorOptions& options,
                                                std::shared_ptr<WorkerTeam> team) {
  return std::make_unique<ReferenceExecutor>(network, input, options, std::move(team));
}

}  // namespace lift_slam::nn
