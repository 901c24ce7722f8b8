#include "lift_slam/nn/onednn_backend.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "lift_slam/nn/onednn_plan.h"

namespace lift_slam::nn {
namespace {

using Arguments = std::unordered_map<int, dnnl::memory>;

// The memory that one thread needs for one stage.
class StageMemory {
 public:
  StageMemory(const Plan& plan, const Stage& stage) : stage_(stage) {
    input_.resize(static_cast<std::size_t>(plan.batch * stage.input_layout.sample_stride));
    std::size_t size = 0, scratch_size = 0;
    for (const VectorLayer& layer : stage.layers) {
      size = std::max(size, static_cast<std::size_t>(layer.output().sample_stride));
      scratch_size = std::max(scratch_size, layer.scratch_size());
    }
    for (AlignedVector<float>& between : between_) between.resize(size);
    scratch_.resize(scratch_size);
    if (stage.primitive) MakeArguments(plan);
  }

  float* input(int sample) { return input_.data() + sample * stage_.input_layout.sample_stride; }

  // Samples [0, count) of input() go to output + i * output_stride.
  void Run(int count, float* output, std::ptrdiff_t output_stride, dnnl::stream& stream) {
    for (int first = 0; first < count; first += stage_.samples) {
      const float* source = stage_.primitive ? RunPrimitive(first, stream) : input(first);
      const std::ptrdiff_t stride = stage_.primitive ? output_sample_stride_ : 0;
      for (int i = 0; i < std::min(stage_.samples, count - first); ++i) {
        RunLayers(source + i * stride, output + (first + i) * output_stride);
      }
    }
  }

 private:
  void MakeArguments(const Plan& plan) {
    const WeightedPrimitive& primitive = *stage_.primitive;
    const dnnl::memory output(primitive.destination, plan.engine);
    const dnnl::memory scratchpad(primitive.scratchpad, plan.engine);
    output_ = static_cast<const float*>(output.get_data_handle());
    std::fill_n(static_cast<char*>(output.get_data_handle()), primitive.destination.get_size(),
                '\0');
    output_sample_stride_ = primitive.destination.data.format_desc.blocking.strides[0];
    dnnl::memory converted;
    if (stage_.convert) converted = dnnl::memory(primitive.source, plan.engine);
    for (int first = 0; first < plan.batch; first += stage_.samples) {
      const dnnl::memory source(stage_.input_desc, plan.engine, input(first));
      if (stage_.convert) {
        convert_arguments_.push_back({{DNNL_ARG_FROM, source}, {DNNL_ARG_TO, converted}});
      }
      primitive_arguments_.push_back({{DNNL_ARG_SRC, stage_.convert ? converted : source},
                                      {DNNL_ARG_WEIGHTS, primitive.weights},
                                      {DNNL_ARG_BIAS, primitive.bias},
                                      {DNNL_ARG_DST, output},
                                      {DNNL_ARG_SCRATCHPAD, scratchpad}});
    }
  }

  const float* RunPrimitive(int first, dnnl::stream& stream) {
    const auto index = static_cast<std::size_t>(first / stage_.samples);
    if (stage_.convert) stage_.convert->execute(stream, convert_arguments_[index]);
    stage_.primitive->primitive.execute(stream, primitive_arguments_[index]);
    stream.wait();
    return output_;
  }

  void RunLayers(const float* source, float* output) {
    std::size_t index = 0;
    for (const VectorLayer& layer : stage_.layers) {
      const bool last = ++index == stage_.layers.size();
      float* destination = last ? output : between_[index % 2].data();
      layer.Run(source, destination, scratch_.data());
      source = destination;
    }
  }

  const Stage& stage_;
  AlignedVector<float> input_;
  AlignedVector<float> between_[2];  // of vector layers
  AlignedVector<float> scratch_;
  std::vector<Arguments> convert_arguments_, primitive_arguments_;  // one a group of samples
  const float* output_ = nullptr;                                   // of the primitive
  std::ptrdiff_t output_sample_stride_ = 0;
};

// One thread's way through the network.
class Worker {
 public:
  explicit Worker(const Plan& plan) : stream_(plan.engine) {
    memories_.reserve(plan.stages.size());
    for (const Stage& stage : plan.stages) memories_.emplace_back(plan, stage);
  }

  float* input() { return memories_.front().input(0); }

  void Run(int count, float* output, std::size_t output_stride) {
    const SingleOpenMpThread single;
    for (std::size_t i = 0; i < memories_.size(); ++i) {
      const bool last = i + 1 == memories_.size();
      float* target = last ? output : memories_[i + 1].input(0);
      const std::ptrdiff_t stride = last ? static_cast<std::ptrdiff_t>(output_stride)
                                         : memories_[i + 1].input(1) - memories_[i + 1].input(0);
      memories_[i].Run(count, target, stride, stream_);
    }
  }

 private:
  dnnl::stream stream_;
  std::vector<StageMemory> memories_;
};

class OneDnnExecutor : public Executor {
 public:
  OneDnnExecutor(const Network& network, const Shape& input, const ExecutorOptions& options,
                 PrecisionChoice precision, std::shared_ptr<WorkerTeam> team)
      : Executor(network, input, options, std::move(precision)),
        plan_(MakePlan(network, input, options, this->precision().used)),
        team_(std::move(team)) {
    const SingleOpenMpThread single;
    workers_.reserve(static_cast<std::size_t>(team_->num_threads()));
    for (int i = 0; i < team_->num_threads(); ++i) workers_.emplace_back(plan_);
  }

 private:
  void Compute(const ReadSamples& read, int count, float* output) override {
    const int num_batches = (count + plan_.batch - 1) / plan_.batch;
    const std::size_t output_size = output_shape().sample_size();
    team_->ForEach(num_batches, [&](int worker, int piece) {
      const int first = piece * plan_.batch;
      const int number = std::min(plan_.batch, count - first);
      Worker& runner = workers_[static_cast<std::size_t>(worker)];
      read(first, number, runner.input());
      runner.Run(number, output + static_cast<std::size_t>(first) * output_size, output_size);
    });
  }

  Plan plan_;
  std::shared_ptr<WorkerTeam> team_;
  std::vector<Worker> workers_;
};

}  // namespace

std::unique_ptr<Executor> MakeOneDnnExecutor(const Network& network, const Shape& input,
                                             const ExecutorOptions& options,
                                             PrecisionChoice precision,
                                             std::shared_ptr<WorkerTeam> team) {
  return std::make_unique<OneDnnExecutor>(network, input, options, std::move(precision),
                                          std::move(team));
}

std::string NetworkLibraryVersion() {
  const dnnl_version_t* version = dnnl_version();
  return fmt::format("oneDNN {}.{}.{}", version->major, version->minor, version->patch);
}

}  // namespace lift_slam::nn
