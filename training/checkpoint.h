#pragma once

#include <torch/torch.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace lift_slam::training {

// How far a run is, beyond what network and optimizer hold.
struct RunState {
  std::int64_t step = 0;     // steps done
  std::int64_t skipped = 0;  // of those, without effect: loss or gradient was not finite
  double best = std::numeric_limits<double>::infinity();  // validation figure so far
  double seconds = 0.0;                                   // spent training
};

// Writes a file that appears whole or not at all; an old one is replaced. Throws InputError when it
// cannot be written (disk full): the old one then is still there. Its SHA-256 stands at its end.
void WriteCheckpoint(const std::filesystem::path& path, const std::string& stage,
                     const RunState& state, const torch::nn::Module& network,
                     torch::optim::Optimizer& optimizer);

// Throws InputError naming the file when it is missing, damaged (another SHA-256, where it has one,
// or values that are not finite), or of another stage or topology.
RunState ReadCheckpoint(const std::filesystem::path& path, const std::string& stage,
                        torch::nn::Module& network, torch::optim::Optimizer& optimizer);

}  // namespace lift_slam::training
