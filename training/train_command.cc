#include "training/train_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "apps/build_info.h"
#include "apps/stop_signal.h"
#include "lift_slam/util/config_file.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_root.h"
#include "lift_slam/util/option_writer.h"
#include "training/trainer.h"
#include "training/word_list.h"

namespace lift_slam::training {
namespace {

struct TrainArguments {
  std::string stage;
  std::filesystem::path output, config_file;
  std::vector<std::string> data, validation, overrides;
  std::string from;
  bool resume = false;
  double minutes = 0.0;
};

// Of a run that goes on: its own settings, changed by the command line.
TrainingOptions ReadOptions(const TrainArguments& arguments) {
  TrainingOptions options;
  std::filesystem::path file = arguments.config_file;
  if (arguments.resume && file.empty()) file = arguments.output / "settings.yaml";
  ConfigureOptions(file, arguments.overrides, MakeOptionRoot(options));
  options.stage = arguments.stage;
  if (!arguments.data.empty()) options.data = JoinWords(arguments.data);
  if (!arguments.validation.empty()) options.validation = JoinWords(arguments.validation);
  if (!arguments.from.empty()) options.from = arguments.from;
  return options;
}

// A line drawn over and over on a terminal; elsewhere one at each validation.
class TrainingBar {
 public:
  void Show(const TrainingProgress& progress) {
    const auto now = std::chrono::steady_clock::now();
    const bool news = progress.validation != validation_;
    validation_ = progress.validation;
    if (!terminal_ && !news) return;
    if (terminal_ && !news && now - shown_ < std::chrono::milliseconds(200)) return;
    shown_ = now;
    const std::string line =
        fmt::format("step {}/{}  loss {:.4f}  {:.2f} steps/s  {:.0f} min left", progress.step,
                    progress.steps, progress.loss, progress.steps_per_s, progress.minutes_left);
    std::cerr << (terminal_ ? "\r\033[K" : "") << line;
    if (news) std::cerr << "  " << validation_;
    std::cerr << (news || !terminal_ ? "\n" : "") << std::flush;
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  std::string validation_;
  std::chrono::steady_clock::time_point shown_{};
};

void Train(const TrainArguments& arguments) {
  RunTraining(ReadOptions(arguments), arguments.output, arguments.resume, arguments.minutes);
}

}  // namespace

bool RunTraining(const TrainingOptions& options, const std::filesystem::path& output, bool resume,
                 double minutes) {
  Trainer trainer(options, output, resume, kGitRevision);
  const StopSignal stop;
  TrainingBar bar;
  const auto start = std::chrono::steady_clock::now();
  bool whole = true;
  trainer.Run([&](const TrainingProgress& progress) {
    bar.Show(progress);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    whole = !stop.Requested() && (minutes <= 0.0 || spent.count() < 60.0 * minutes);
    return whole;
  });
  std::cout << fmt::format(
      "{}: {} steps done, {} skipped, {}\n", output.string(), trainer.state().step,
      trainer.state().skipped,
      options.validation.empty()
          ? "no validation sets: the last weights are kept"
          : fmt::format("best validation figure {:.5f}", trainer.state().best));
  return whole;
}

void AddTrainCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("train", "Train one of the three networks");
  auto arguments = std::make_shared<TrainArguments>();
  command->add_option("STAGE", arguments->stage, "descriptor, orientation or detector")
      ->required()
      ->check(CLI::IsMember({"descriptor", "orientation", "detector"}));
  command->add_option("--output", arguments->output, "Folder of the run")->required();
  command->add_option("--data", arguments->data, "Training sets, PATH or PATH=SHARE");
  command->add_option("--validation", arguments->validation, "Sets of other images");
  command->add_option("--from", arguments->from, "Weights to begin with (.safetensors)");
  command->add_flag("--resume", arguments->resume, "Go on from the folder's checkpoint");
  command->add_option("--minutes", arguments->minutes, "End after so long, with a checkpoint");
  command->add_option("--config", arguments->config_file, "YAML file of options");
  command->add_option("--set", arguments->overrides, "One option, KEY=VALUE; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->callback([arguments] { Train(*arguments); });
  CLI::App* options = app.add_subcommand("options", "Print all options with their defaults");
  options->callback([] {
    TrainingOptions defaults;
    std::cout << OptionsToYaml(MakeOptionRoot(defaults));
  });
}

}  // namespace lift_slam::training
