#include "training/checkpoint.h"

#include <fmt/format.h>

#include <sstream>

#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam::training {
namespace {

using torch::Tensor;

constexpr const char* kFormat = "lift_slam training checkpoint 1";
// Behind libtorch's archive; 64 digits follow. The first programs wrote none.
constexpr std::string_view kDigestMark = "\nSHA-256 of all before: ";
constexpr std::size_t kDigestSize = kDigestMark.size() + 64;

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

// The archive, compared with its SHA-256 where there is one.
std::string ReadArchive(const std::filesystem::path& path) {
  std::string bytes = ReadText(path);
  if (bytes.size() < kDigestSize) return bytes;
  const std::string end = bytes.substr(bytes.size() - kDigestSize);
  if (!end.starts_with(kDigestMark)) return bytes;
  bytes.resize(bytes.size() - kDigestSize);
  if (end.substr(kDigestMark.size()) != Sha256Hex(bytes)) {
    throw InputError(
        fmt::format("{}: is damaged, its SHA-256 is not the one written with it", path.string()));
  }
  return bytes;
}

void CheckFinite(const std::filesystem::path& path, const std::string& name, const Tensor& tensor) {
  if (torch::isfinite(tensor).all().item<bool>()) return;
  throw InputError(fmt::format(
      "{}: '{}' holds values that are not finite: the checkpoint is damaged", path.string(), name));
}

void CheckMomentsFinite(const std::filesystem::path& path,
                        const torch::optim::Optimizer& optimizer) {
  for (const auto& entry : optimizer.state()) {
    const auto* adam = dynamic_cast<const torch::optim::AdamParamState*>(entry.second.get());
    if (adam == nullptr) continue;
    CheckFinite(path, "optimizer", adam->exp_avg());
    CheckFinite(path, "optimizer", adam->exp_avg_sq());
  }
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
    CheckFinite(path, parameter.key(), stored);
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
  const std::string text = std::move(bytes).str();
  WriteTextAtomically(path, fmt::format("{}{}{}", text, kDigestMark, Sha256Hex(text)));
}

RunState ReadCheckpoint(const std::filesystem::path& path, const std::string& stage,
                        torch::nn::Module& network, torch::optim::Optimizer& optimizer) {
  std::istringstream bytes(ReadArchive(path));
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
    CheckMomentsFinite(path, optimizer);
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
