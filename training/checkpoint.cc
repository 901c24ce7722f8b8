#include "training/checkpoint.h"

#include <fmt/format.h>

#include <sstream>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam::training {
namespace {

using torch::Tensor;

constexpr const char* kFormat = "lift_slam training checkpoint 1";

Tensor StateTensor(const RunState& state) {
  return torch::tensor({static_cast<double>(state.step), static_cast<double>(state.skipped),
                        state.best, state.seconds},
                       torch::kFloat64);
}

// The first line of a message of libtorch; the others are a stack trace.
std::string FirstLine(const std::exception& error) {
  const std::string text = error.what();
  return text.substr(0, text.find('\n'));
}

void ReadNetwork(const std::filesystem::path& path, torch::serialize::InputArchive& archive,
                 torch::nn::Module& network) {
  const torch::NoGradGuard no_gradients;
  for (auto& parameter : network.named_parameters()) {
    Tensor stored;
    if (!archive.try_read("network." + parameter.key(), stored) ||
        stored.sizes() != parameter.value().sizes()) {
      throw InputError(fmt::format(
          "{}: '{}' is missing or of another shape: the checkpoint is of another topology",
          path.string(), parameter.key()));
    }
    parameter.value().copy_(stored);
  }
}

}  // namespace

void WriteCheckpoint(const std::filesystem::path& path, const std::string& stage,
                     const RunState& state, const torch::nn::Module& network,
                     torch::optim::Optimizer& optimizer) {
  torch::serialize::OutputArchive archive, adam;
  archive.write("format", c10::IValue(std::string(kFormat)));
  archive.write("stage", c10::IValue(stage));
  archive.write("state", StateTensor(state));
  for (const auto& parameter : network.named_parameters()) {
    archive.write("network." + parameter.key(), parameter.value());
  }
  optimizer.save(adam);
  archive.write("optimizer", adam);
  std::ostringstream bytes;
  archive.save_to(bytes);
  WriteTextAtomically(path, bytes.str());
}

RunState ReadCheckpoint(const std::filesystem::path& path, const std::string& stage,
                        torch::nn::Module& network, torch::optim::Optimizer& optimizer) {
  std::istringstream bytes(ReadText(path));
  try {
    torch::serialize::InputArchive archive, adam;
    archive.load_from(bytes);
    c10::IValue format, stored_stage;
    archive.read("format", format);
    archive.read("stage", stored_stage);
    if (format.toStringRef() != kFormat || stored_stage.toStringRef() != stage) {
      throw InputError(fmt::format("{}: is a checkpoint of '{}' ({}), not of '{}'", path.string(),
                                   stored_stage.toStringRef(), format.toStringRef(), stage));
    }
    ReadNetwork(path, archive, network);
    archive.read("optimizer", adam);
    optimizer.load(adam);
    Tensor numbers;
    archive.read("state", numbers);
    const auto at = [&](std::int64_t i) { return numbers[i].item<double>(); };
    return {static_cast<std::int64_t>(at(0)), static_cast<std::int64_t>(at(1)), at(2), at(3)};
  } catch (const c10::Error& error) {
    throw InputError(
        fmt::format("{}: is no checkpoint, or damaged: {}", path.string(), FirstLine(error)));
  }
}

}  // namespace lift_slam::training
