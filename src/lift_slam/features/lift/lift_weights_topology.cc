#include "lift_slam/features/lift/lift_weights_topology.h"

#include <cmath>

#include "lift_slam/util/random.h"

namespace lift_slam {
namespace {

using nn::ActivationKind;
using nn::PoolingKind;
using nn::Shape;
using nn::Tensor;

nn::Convolution ZeroConvolution(int outputs, int inputs, int size) {
  return {Tensor({outputs, inputs, size, size}),
          std::vector<float>(static_cast<std::size_t>(outputs))};
}

nn::FullyConnected ZeroFullyConnected(int outputs, int inputs) {
  return {Tensor({outputs, inputs, 1, 1}), std::vector<float>(static_cast<std::size_t>(outputs))};
}

nn::SubtractiveNormalization GaussianNormalization() {
  constexpr int kSize = 5;
  constexpr double kSigma = 1.25;  // a quarter of the size
  nn::SubtractiveNormalization layer{Tensor({1, 1, kSize, kSize})};
  double sum = 0.0;
  for (int i = 0; i < kSize * kSize; ++i) {
    const int dy = i / kSize - kSize / 2, dx = i % kSize - kSize / 2;
    const double value = std::exp(-(dx * dx + dy * dy) / (2 * kSigma * kSigma));
    layer.kernel.values()[static_cast<std::size_t>(i)] = static_cast<float>(value);
    sum += value;
  }
  for (float& v : layer.kernel.values()) v = static_cast<float>(v / sum);
  return layer;
}

// Names of the parameters of one module: convN, fcN and normN count from 1.
void AddParameters(const std::string& module, nn::Network& network,
                   std::vector<LiftParameter>& parameters) {
  int convolutions = 0, connected = 0, normalizations = 0;
  for (nn::Layer& layer : network) {
    if (auto* convolution = std::get_if<nn::Convolution>(&layer)) {
      const std::string name = module + ".conv" + std::to_string(++convolutions);
      const Shape& s = convolution->weights.shape();
      parameters.push_back({name + ".weight", {s.n, s.c, s.h, s.w}, convolution->weights.values()});
      parameters.push_back({name + ".bias", {s.n}, convolution->bias});
    } else if (auto* full = std::get_if<nn::FullyConnected>(&layer)) {
      const std::string name = module + ".fc" + std::to_string(++connected);
      const Shape& s = full->weights.shape();
      parameters.push_back({name + ".weight", {s.n, s.c}, full->weights.values()});
      parameters.push_back({name + ".bias", {s.n}, full->bias});
    } else if (auto* normalization = std::get_if<nn::SubtractiveNormalization>(&layer)) {
      const std::string name = module + ".norm" + std::to_string(++normalizations) + ".kernel";
      const Shape& s = normalization->kernel.shape();
      parameters.push_back({name, {s.h, s.w}, normalization->kernel.values()});
    }
  }
}

}  // namespace

nn::Network LiftDetectorLayers() { return {ZeroConvolution(16, 1, 25), nn::Ghh{}}; }

nn::Network LiftOrientationLayers() {
  const nn::Activation relu{ActivationKind::kRelu};
  const nn::Pooling pool{PoolingKind::kMax, 2};
  return {ZeroConvolution(10, 1, 5),
          relu,
          pool,
          ZeroConvolution(20, 10, 5),
          relu,
          pool,
          ZeroConvolution(50, 20, 3),
          relu,
          pool,
          ZeroFullyConnected(1600, 1250),
          nn::Ghh{},
          ZeroFullyConnected(32, 100),
          nn::Ghh{}};
}

nn::Network LiftDescriptorLayers(LiftTopology topology) {
  const bool t = topology == LiftTopology::kT;
  const nn::Activation activation{t ? ActivationKind::kTanh : ActivationKind::kRelu};
  const PoolingKind pooling = t ? PoolingKind::kL2 : PoolingKind::kAverage;
  nn::Network network = {ZeroConvolution(32, 1, 7), activation, nn::Pooling{pooling, 2}};
  if (t) network.emplace_back(GaussianNormalization());
  network.insert(network.end(), {ZeroConvolution(64, 32, 6), activation, nn::Pooling{pooling, 3}});
  if (t) network.emplace_back(GaussianNormalization());
  network.insert(network.end(), {ZeroConvolution(128, 64, 5), activation, nn::Pooling{pooling, 4}});
  return network;
}

std::vector<LiftParameter> Parameters(LiftWeights& weights) {
  std::vector<LiftParameter> parameters;
  AddParameters("detector", weights.detector, parameters);
  if (weights.orientation) AddParameters("orientation", *weights.orientation, parameters);
  AddParameters("descriptor", weights.descriptor, parameters);
  return parameters;
}

LiftWeights ZeroLiftWeights(LiftTopology topology, bool with_orientation) {
  LiftWeights weights;
  weights.topology = topology;
  weights.detector = LiftDetectorLayers();
  if (with_orientation) weights.orientation = LiftOrientationLayers();
  weights.descriptor = LiftDescriptorLayers(topology);
  return weights;
}

LiftWeights RandomLiftWeights(LiftTopology topology, std::uint64_t seed, bool with_orientation) {
  LiftWeights weights = ZeroLiftWeights(topology, with_orientation);
  weights.name = "random";
  weights.provenance = "He initialisation, seed " + std::to_string(seed);
  Random random(seed);
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (!parameter.name.ends_with(".weight")) continue;
    const double inputs =
        static_cast<double>(parameter.values.size()) / static_cast<double>(parameter.shape[0]);
    const double deviation = std::sqrt(2.0 / inputs);
    for (float& v : parameter.values) v = static_cast<float>(deviation * random.Normal());
  }
  return weights;
}

}  // namespace lift_slam
