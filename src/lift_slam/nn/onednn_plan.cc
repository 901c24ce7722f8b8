#include "lift_slam/nn/onednn_plan.h"

#include <algorithm>

#include "lift_slam/util/check.h"

namespace lift_slam::nn {
namespace {

// The output of a primitive should stay within the second-level cache with its weights.
constexpr std::size_t kStageBytes = std::size_t{1} << 19;

// The layers of a stage by their place in the network, before anything is laid out.
struct StageLayers {
  const Layer* weighted = nullptr;  // Convolution or FullyConnected
  std::optional<ActivationKind> activation;
  std::vector<const Layer*> others;
  bool nonnegative_input = false;
};

bool IsWeighted(const Layer& layer) {
  return std::holds_alternative<Convolution>(layer) ||
         std::holds_alternative<FullyConnected>(layer);
}

bool IsNonnegativeAfter(const Layer& layer, bool before) {
  if (const auto* activation = std::get_if<Activation>(&layer)) {
    return activation->kind == ActivationKind::kRelu || before;
  }
  if (const auto* pooling = std::get_if<Pooling>(&layer)) {
    return pooling->kind == PoolingKind::kL2 || before;
  }
  return false;
}

std::vector<StageLayers> SplitIntoStages(const Network& network) {
  std::vector<StageLayers> stages;
  bool nonnegative = false;
  for (const Layer& layer : network) {
    const auto* activation = std::get_if<Activation>(&layer);
    if (IsWeighted(layer)) {
      stages.emplace_back();
      stages.back().weighted = &layer;
      stages.back().nonnegative_input = nonnegative;
    } else if (activation && !stages.empty() && stages.back().weighted &&
               stages.back().others.empty() && !stages.back().activation) {
      stages.back().activation = activation->kind;
    } else {
      if (stages.empty()) stages.emplace_back();
      stages.back().others.push_back(&layer);
    }
    nonnegative = IsNonnegativeAfter(layer, nonnegative);
  }
  return stages;
}

// The largest divisor of the batch whose outputs fit the cache.
int SamplesAtATime(const Layer& layer, const Shape& input, int batch) {
  if (std::holds_alternative<FullyConnected>(layer)) return batch;
  const std::size_t bytes = OutputShape(layer, input).sample_size() * sizeof(float);
  int samples = static_cast<int>(
      std::clamp<std::size_t>(kStageBytes / bytes, 1, static_cast<std::size_t>(batch)));
  while (batch % samples != 0) --samples;
  return samples;
}

Shape WithSamples(Shape shape, int samples) {
  shape.n = samples;
  return shape;
}

class Planner {
 public:
  Planner(const ExecutorOptions& options, Precision precision)
      : options_(options), precision_(precision) {
    plan_.batch = options.batch;
  }

  Plan Make(const Network& network, const Shape& input) {
    const std::vector<StageLayers> split = SplitIntoStages(network);
    std::vector<Shape> inputs = {input};
    for (const StageLayers& layers : split) {
      plan_.stages.push_back(MakeStage(layers, inputs.back()));
      Shape shape = inputs.back();
      if (layers.weighted) shape = OutputShape(*layers.weighted, shape);
      for (const Layer* layer : layers.others) shape = OutputShape(*layer, shape);
      inputs.push_back(shape);
    }
    const ChannelLayout result = ChannelLayout::Nchw(inputs.back());
    for (std::size_t i = 0; i < split.size(); ++i) {
      const bool last = i + 1 == split.size();
      AddVectorLayers(split[i], last ? result : plan_.stages[i + 1].input_layout, plan_.stages[i]);
    }
    return std::move(plan_);
  }

 private:
  Stage MakeStage(const StageLayers& layers, const Shape& input) {
    Stage stage;
    stage.input = input;
    const bool first = plan_.stages.empty();
    if (!layers.weighted) {  // only the first stage may lack a primitive
      stage.input_layout = ChannelLayout::Nchw(input);
      return stage;
    }
    stage.samples = SamplesAtATime(*layers.weighted, input, plan_.batch);
    stage.primitive = MakePrimitiveFor(layers, WithSamples(input, stage.samples));
    const dnnl::memory::desc& source = stage.primitive->source;
    const bool flat = source.data.ndims == 2;
    stage.input_desc =
        !first ? AsFloat32(source)
        : flat ? dnnl::memory::desc({stage.samples, input.c}, dnnl::memory::data_type::f32,
                                    dnnl::memory::format_tag::nc)
               : PlainDesc(WithSamples(input, stage.samples));
    stage.input_layout = LayoutOf(stage.input_desc, input);
    if (stage.input_desc != source) {
      stage.convert =
          MakeReorder(stage.input_desc, source, stage.primitive->source_scale, plan_.engine);
    }
    return stage;
  }

  WeightedPrimitive MakePrimitiveFor(const StageLayers& layers, const Shape& input) {
    PrimitiveRequest request{.input = input, .activation = layers.activation};
    const std::size_t index = num_weighted_++;
    if (input.c > 1) request.precision = precision_;
    if (request.precision == Precision::kInt8) {
      LIFT_SLAM_CHECK(index < options_.activation_ranges.size(), "{} activation ranges, too few",
                      options_.activation_ranges.size());
      request.activation_range = options_.activation_ranges[index];
      request.nonnegative_input = layers.nonnegative_input;
    }
    if (const auto* convolution = std::get_if<Convolution>(layers.weighted)) {
      return MakePrimitive(*convolution, request, plan_.engine);
    }
    return MakePrimitive(std::get<FullyConnected>(*layers.weighted), request, plan_.engine);
  }

  void AddVectorLayers(const StageLayers& layers, const ChannelLayout& target, Stage& stage) {
    ChannelLayout layout = stage.input_layout;
    if (layers.weighted) {
      layout = LayoutOf(stage.primitive->destination, OutputShape(*layers.weighted, stage.input));
    }
    for (const Layer* layer : layers.others) {
      const bool last = layer == layers.others.back();
      const Shape shape = OutputShape(*layer, layout.shape);
      stage.layers.emplace_back(*layer, layout, last ? target : layout.For(shape));
      layout = stage.layers.back().output();
    }
    if (stage.layers.empty()) stage.layers.emplace_back(layout, target);
  }

  const ExecutorOptions& options_;
  Precision precision_;
  Plan plan_;
  std::size_t num_weighted_ = 0;
};

}  // namespace

Plan MakePlan(const Network& network, const Shape& input, const ExecutorOptions& options,
              Precision precision) {
  const SingleOpenMpThread single;  // primitives are laid out for the threads they see here
  LIFT_SLAM_CHECK(!network.empty(), "a network without layers");
  return Planner(options, precision).Make(network, input);
}

}  // namespace lift_slam::nn
