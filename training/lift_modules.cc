#include "training/lift_modules.h"

#include <ATen/autocast_mode.h>

#include <algorithm>

#include "lift_slam/util/check.h"
#include "lift_slam/util/system_info.h"

namespace lift_slam::training {

using torch::Tensor;

DescriptorModule::DescriptorModule()
    : conv1(register_module("conv1", torch::nn::Conv2d(1, 32, 7))),
      conv2(register_module("conv2", torch::nn::Conv2d(32, 64, 6))),
      conv3(register_module("conv3", torch::nn::Conv2d(64, 128, 5))) {}

Tensor DescriptorModule::forward(const Tensor& patches) {
  // oneDNN has no fast kernels for one channel with the channels last; for many it needs no copies
  // then.
  Tensor x = torch::avg_pool2d(torch::relu(conv1(patches)), 2);
  x = x.contiguous(torch::MemoryFormat::ChannelsLast);
  x = torch::avg_pool2d(torch::relu(conv2(x)), 3);
  x = torch::relu(conv3(x)).to(torch::kFloat32);
  return torch::avg_pool2d(x, 4).flatten(1);
}

OrientationModule::OrientationModule()
    : conv1(register_module("conv1", torch::nn::Conv2d(1, 10, 5))),
      conv2(register_module("conv2", torch::nn::Conv2d(10, 20, 5))),
      conv3(register_module("conv3", torch::nn::Conv2d(20, 50, 3))),
      fc1(register_module("fc1", torch::nn::Linear(1250, 1600))),
      fc2(register_module("fc2", torch::nn::Linear(100, 32))) {}

Tensor OrientationModule::forward(const Tensor& patches) {
  Tensor x = torch::max_pool2d(torch::relu(conv1(patches)), 2);
  x = torch::max_pool2d(torch::relu(conv2(x)), 2);
  x = torch::max_pool2d(torch::relu(conv3(x)), 2);
  x = Ghh(fc1(x.to(torch::kFloat32).flatten(1)));
  return Ghh(fc2(x));
}

DetectorModule::DetectorModule() : conv1(register_module("conv1", torch::nn::Conv2d(1, 16, 25))) {}

Tensor DetectorModule::forward(const Tensor& images) {
  return Ghh(conv1(images).to(torch::kFloat32));
}

Tensor Ghh(const Tensor& channels) {
  std::vector<std::int64_t> shape = channels.sizes().vec();
  LIFT_SLAM_CHECK(shape.size() >= 2 && shape[1] % 16 == 0, "{} dimensions", shape.size());
  std::vector<std::int64_t> split = {shape[0], shape[1] / 16, 4, 4};
  split.insert(split.end(), shape.begin() + 2, shape.end());
  const Tensor maxima = channels.reshape(split).amax(3);  // (N, units, 4, ...)
  return maxima.select(2, 0) - maxima.select(2, 1) + maxima.select(2, 2) - maxima.select(2, 3);
}

Tensor UnitDirections(const Tensor& outputs) {
  constexpr double kTiny = 1e-8;
  return outputs / (outputs.pow(2).sum(1, /*keepdim=*/true) + kTiny).sqrt();
}

namespace {

// The parameters of the weights that belong to a network, with the network's own.
template <class Function>
void ForEachParameter(LiftWeights& weights, const std::string& module,
                      const torch::nn::Module& network, const Function& function) {
  const auto own = network.named_parameters();
  std::size_t count = 0;
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (!parameter.name.starts_with(module + ".")) continue;
    Tensor tensor = own[parameter.name.substr(module.size() + 1)];
    LIFT_SLAM_CHECK(tensor.sizes().vec() == parameter.shape, "{} has another shape",
                    parameter.name);
    function(parameter, tensor);
    ++count;
  }
  LIFT_SLAM_CHECK(count == own.size(), "{} of {} parameters of the {}", count, own.size(), module);
}

}  // namespace

void LoadParameters(LiftWeights& weights, const std::string& module, torch::nn::Module& network) {
  const torch::NoGradGuard no_gradients;
  ForEachParameter(weights, module, network, [](const LiftParameter& parameter, Tensor& tensor) {
    tensor.copy_(torch::from_blob(parameter.values.data(), tensor.sizes(), torch::kFloat32));
  });
}

void StoreParameters(const torch::nn::Module& network, const std::string& module,
                     LiftWeights& weights) {
  ForEachParameter(weights, module, network, [](const LiftParameter& parameter, Tensor& tensor) {
    const Tensor values = tensor.detach().contiguous();
    std::copy_n(values.data_ptr<float>(), parameter.values.size(), parameter.values.begin());
  });
}

Bfloat16Scope::Bfloat16Scope(bool enabled) {
  const std::vector<std::string> features = CpuFeatures();
  enabled_ =
      enabled && std::find(features.begin(), features.end(), "avx512_bf16") != features.end();
  if (!enabled_) return;
  at::autocast::set_autocast_cpu_dtype(torch::kBFloat16);
  at::autocast::set_cpu_enabled(true);
}

Bfloat16Scope::~Bfloat16Scope() {
  if (!enabled_) return;
  at::autocast::clear_cache();
  at::autocast::set_cpu_enabled(false);
}

}  // namespace lift_slam::training
