#include "training/fine_tune_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "lift_slam/features/lift/lift_weights.h"
#include "lift_slam/util/config_file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_root.h"
#include "training/colmap_run.h"
#include "training/fine_tuning.h"
#include "training/weights_calibration.h"
#include "training/word_list.h"

namespace lift_slam::training {
namespace {

namespace fs = std::filesystem;

struct FineTuneArguments {
  std::string from, modules = "orientation", preset;
  std::vector<std::string> data, validation, overrides;
  fs::path output, root;
  double minutes = 0.0;
};

// What the paper trained on (section Fine-tuned): sequences below the data set's folder.
struct Preset {
  const char* name;
  std::vector<const char*> sequences;
};

const std::vector<Preset>& Presets() {
  static const std::vector<Preset> presets = {
      {"kitti", {"sequences/00", "sequences/06", "sequences/09", "sequences/10"}},
      {"euroc", {"MH_04_difficult", "V1_03_difficult", "V2_03_difficult"}},
  };
  return presets;
}

// Reconstructs the sequences of a preset and makes sets of them; those that are there are kept.
void PreparePreset(FineTuneArguments& arguments) {
  for (const Preset& preset : Presets()) {
    if (arguments.preset != preset.name) continue;
    for (const char* name : preset.sequences) {
      const fs::path sequence = arguments.root / name;
      const fs::path folder = arguments.output / "sets" / fs::path(name).filename();
      for (const Part part : {Part::kTraining, Part::kValidation}) {
        const fs::path set = folder / kPartNames[static_cast<std::size_t>(part)];
        (part == Part::kTraining ? arguments.data : arguments.validation).push_back(set.string());
        if (fs::exists(set / "manifest.json")) continue;
        std::cerr << fmt::format("Preparing {}\n", set.string());
        const ColmapPaths paths =
            ReconstructSequence(sequence.string(), folder / "reconstruction", {});
        TrainingSetWriter writer(set);
        ImportColmap(
            paths, {.source = sequence.string(), .licence = "unknown", .author = "unknown"},
            {.part = part}, [](int, int, std::size_t) {}, writer);
        writer.Finish("preset " + arguments.preset);
      }
    }
  }
}

// Training comes to a median distance of the nearest wrong point of so many margins.
constexpr double kNearestWrongInMargins = 2.3;

// Gentler than from the beginning: the weights are good already.
TrainingOptions FineTuningDefaults(const LiftWeights& from) {
  constexpr double kLearningRate = 1e-4;
  constexpr int kSteps = 5000;
  TrainingOptions options;
  for (ScheduleOptions* schedule :
       {&options.descriptor.schedule, &options.orientation.schedule, &options.detector.schedule}) {
    schedule->learning_rate = kLearningRate;
    schedule->steps = kSteps;
  }
  // The first wrong points are easy ones for random weights only: these know the hard ones already.
  options.descriptor.easy_steps = 0;
  // Finished weights are scaled (CarryOverCalibration, calibrate): with the margin of the beginning
  // they would learn a larger scale before all else, and worse.
  if (from.distances) {
    options.descriptor.margin = from.distances->nearest_wrong[2] / kNearestWrongInMargins;
  }
  // The angle between two real views is not known.
  options.orientation.loss = OrientationLoss::kDescriptor;
  return options;
}

std::vector<std::string> Stages(const std::string& modules) {
  if (modules == "all") return {"descriptor", "orientation", "detector"};
  return {modules};
}

// What the SLAM uses of the weights beside the networks: thresholds and ranges for int8.
void Calibrate(const LiftWeights& from, const FineTuneArguments& arguments,
               const TrainingOptions& options, LiftWeights& weights) {
  if (arguments.modules == "orientation" || arguments.modules == "detector") {
    weights.distances = from.distances;
    weights.descriptor_ranges = from.descriptor_ranges;
    return;
  }
  const bool held_out = !arguments.validation.empty();
  std::cout << fmt::format(
      "Distances of descriptors measured on {}\n",
      held_out ? "the validation sets" : "the training sets (no --validation given)");
  CarryOverCalibration(from, OpenTrainingSets(held_out ? options.validation : options.data), {},
                       weights);
}

void FineTune(FineTuneArguments& arguments) {
  if (!arguments.preset.empty()) PreparePreset(arguments);
  if (arguments.data.empty()) {
    throw InputError("fine-tune needs --data SET..., or --preset with --root");
  }
  const LiftWeights from = ReadLiftWeights(arguments.from);
  TrainingOptions options = FineTuningDefaults(from);
  ConfigureOptions({}, arguments.overrides, MakeOptionRoot(options));
  options.data = JoinWords(arguments.data);
  options.validation = JoinWords(arguments.validation);
  options.from = arguments.from;
  TunedWeights tuned =
      TrainInTurn(Stages(arguments.modules), options, arguments.output, arguments.minutes);
  if (!tuned.is_complete) std::cerr << "Ended early; the same command goes on.\n";
  if (!tuned.weights) return;
  LiftWeights& weights = *tuned.weights;
  weights.name = fmt::format("fine-tuned ({}{})", arguments.modules,
                             tuned.is_complete ? "" : ", not to the end");
  Calibrate(from, arguments, options, weights);
  const fs::path file = arguments.output / "weights.safetensors";
  WriteLiftWeights(weights, file);
  std::cout << fmt::format("{}: SHA-256 {}\n", file.string(), weights.sha256);
  if (arguments.modules == "orientation") {
    std::cout << "Only the orientation was trained: lift_slam uses it with --set "
                 "slam.lift.upright=false (--modules all trains the others too)\n";
  }
}

}  // namespace

void AddFineTuneCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "fine-tune", "Go on training weights on one's own images (the paper: orientation only)");
  auto arguments = std::make_shared<FineTuneArguments>();
  command->add_option("--from", arguments->from, "Weights to begin with")->required();
  command->add_option("--output", arguments->output, "Folder of the runs and the result")
      ->required();
  command->add_option("--data", arguments->data, "Training sets, PATH or PATH=SHARE");
  command->add_option("--validation", arguments->validation, "Sets of other images");
  command->add_option("--modules", arguments->modules, "What to train; all: one after the other")
      ->check(CLI::IsMember({"descriptor", "orientation", "detector", "all"}))
      ->capture_default_str();
  command
      ->add_option("--preset", arguments->preset,
                   "kitti: 00, 06, 09, 10; euroc: MH_04, V1_03, V2_03; as the paper, by COLMAP")
      ->check(CLI::IsMember({"kitti", "euroc"}));
  command->add_option("--root", arguments->root, "Folder of the preset's data set");
  command->add_option("--minutes", arguments->minutes, "End each stage after so long");
  command->add_option("--set", arguments->overrides, "One option, KEY=VALUE; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->callback([arguments] { FineTune(*arguments); });
}

}  // namespace lift_slam::training
