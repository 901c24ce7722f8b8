#include "training/fine_tuning.h"

#include <fmt/format.h>

#include <iostream>

#include "training/stage_network.h"
#include "training/train_command.h"

namespace lift_slam::training {
namespace {

namespace fs = std::filesystem;

std::vector<float> DescriptorValues(LiftWeights& weights) {
  std::vector<float> values;
  for (const LiftParameter& parameter : Parameters(weights)) {
    if (!parameter.name.starts_with("descriptor.")) continue;
    values.insert(values.end(), parameter.values.begin(), parameter.values.end());
  }
  return values;
}

bool LearnsByDescriptor(const TrainingOptions& options) {
  return (options.stage == "orientation" &&
          options.orientation.loss == OrientationLoss::kDescriptor) ||
         (options.stage == "detector" && options.detector.pair_steps > 0);
}

void WarnOfAnotherDescriptor(const TrainingOptions& options, const fs::path& folder,
                             LiftWeights& weights) {
  const fs::path best = folder / "best.safetensors";
  if (!LearnsByDescriptor(options) || !fs::exists(best)) return;
  LiftWeights trained = ReadLiftWeights(best);
  if (DescriptorValues(trained) == DescriptorValues(weights)) return;
  std::cerr << fmt::format(
      "{}: was trained against another descriptor; remove the folder to train it anew\n",
      folder.string());
}

// The last line of a run's provenance is its own.
void TakeBest(const fs::path& best, const std::string& stage, LiftWeights& weights) {
  const LiftWeights trained = ReadLiftWeights(best);
  TakeNetwork(StageNamed(stage), trained, weights);
  if (!weights.provenance.empty()) weights.provenance += '\n';
  weights.provenance += trained.provenance.substr(trained.provenance.rfind('\n') + 1);
}

}  // namespace

TunedWeights TrainInTurn(const std::vector<std::string>& stages, TrainingOptions options,
                         const std::filesystem::path& output, double minutes) {
  LiftWeights weights = ReadLiftWeights(options.from);
  weights.distances.reset();
  weights.descriptor_ranges.clear();
  TunedWeights tuned;
  for (const std::string& stage : stages) {
    options.stage = stage;
    const fs::path folder = output / stage;
    WarnOfAnotherDescriptor(options, folder, weights);
    const bool resume = fs::exists(folder / "checkpoint.pt");
    tuned.is_complete = RunTraining(options, folder, resume, minutes);
    const fs::path best = folder / "best.safetensors";
    if (fs::exists(best)) {
      TakeBest(best, stage, weights);
      tuned.weights = weights;
    }
    if (!tuned.is_complete || &stage == &stages.back()) break;
    options.from = (output / fmt::format("after-{}.safetensors", stage)).string();
    WriteLiftWeights(weights, options.from);
  }
  return tuned;
}

}  // namespace lift_slam::training
