#include "apps/run_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "apps/build_info.h"
#include "apps/config_arguments.h"
#include "apps/exit_code.h"
#include "apps/output_folder.h"
#include "apps/run_outputs.h"
#include "apps/sequence_arguments.h"
#include "apps/sequence_truth.h"
#include "apps/slam_run.h"
#include "lift_slam/datasets/sequence_format.h"
#include "lift_slam/image/image_threads.h"
#include "lift_slam/util/input_error.h"
#include "lift_slam/util/option_writer.h"
#include "lift_slam/util/sha256.h"

namespace lift_slam {
namespace {

struct RunArguments {
  SequenceArguments sequence;
  ConfigArguments config;
  std::filesystem::path output;
  std::string features, weights, vocabulary;  // empty: as the options say
  std::optional<int> seed;
  std::string mode;
  RunFiles files;
  std::string distort;  // empty: images as they are
};

ProgramOptions EffectiveOptions(const RunArguments& arguments) {
  ConfigArguments config = arguments.config;
  // The dedicated arguments are the last overrides, so that they are checked and named alike.
  if (arguments.seed) config.overrides.push_back(fmt::format("seed={}", *arguments.seed));
  if (!arguments.mode.empty()) config.overrides.push_back("mode=" + arguments.mode);
  if (!arguments.features.empty()) {
    config.overrides.push_back("slam.features=" + arguments.features);
  }
  if (!arguments.weights.empty()) {
    config.overrides.push_back("slam.lift_weights=" + arguments.weights);
  }
  if (!arguments.vocabulary.empty()) {
    config.overrides.push_back("slam.loop_closing.vocabulary=" + arguments.vocabulary);
  }
  return config.Read();
}

std::vector<ImageDistortion> Distortions(const RunArguments& arguments) {
  if (arguments.distort.empty()) return {};
  return ParseImageDistortions(arguments.distort);
}

bool IsKitti(SequenceFormat format) {
  return format == SequenceFormat::kKittiOdometry || format == SequenceFormat::kKittiRaw;
}

std::string ToText(const SelfCalibrationReport& calibration) {
  const auto found = [&] {
    return fmt::format("focal length x {:.4f}, k1 {:+.4f}", calibration.estimate.focal_scale,
                       calibration.estimate.k1);
  };
  if (calibration.usable()) return found();
  if (calibration.refusal == CalibrationRefusal::kNotClearlyOff) {
    return fmt::format("left as given. {} ({})", Explain(calibration.refusal), found());
  }
  return fmt::format("left as given. {}", Explain(calibration.refusal));
}

// SHA-256 of all that decides a trajectory but the seed: runs with the same are runs of one thing.
std::string SettingsSha256(ProgramOptions options, const SequenceOptions& sequence) {
  options.seed = 0;
  options.mode = {};
  options.outputs = {};
  return Sha256Hex(fmt::format("{}\nframes {}:{}:{}\n", OptionsToYaml(MakeOptionRoot(options)),
                               sequence.first, sequence.last, sequence.step));
}

FinishedRun Conclude(const RunArguments& arguments, const SequenceInfo& info,
                     const RunRecord& record, ProgramOptions& options) {
  const SequenceTruth truth = TruthOf(info, options.evaluation);
  FinishedRun finished(record, EvaluateRun(record, truth.poses, truth.options));
  finished.dataset = FormatName(info.format);
  finished.sequence = info.name;
  finished.configuration = kFeatureTypeNames[static_cast<int>(options.slam.features.type)];
  finished.config_yaml = OptionsToYaml(MakeOptionRoot(options));
  finished.ground_truth = truth.poses;
  finished.ground_truth_view = IsKitti(info.format) ? TopView::kXZ : TopView::kXY;
  finished.provenance = CollectProvenance(kProgramVersion, kGitRevision, MakeOptionRoot(options));
  finished.settings = {{"mode", std::string(kRunModeNames[static_cast<int>(options.mode)])},
                       {"seed", std::to_string(options.seed)},
                       {"source", arguments.sequence.source},
                       {"calibration", info.camera->source},
                       {"settings_sha256", SettingsSha256(options, arguments.sequence.Options())}};
  if (!arguments.distort.empty()) {
    finished.settings.emplace_back("distortion", ToText(Distortions(arguments)));
  }
  if (info.ground_truth) finished.settings.emplace_back("ground truth", info.ground_truth->source);
  if (!arguments.files.maps.load.empty()) {
    finished.settings.emplace_back("loaded map", arguments.files.maps.load.string());
  }
  for (std::size_t i = 0; i < record.calibrations.size(); ++i) {
    finished.settings.emplace_back(fmt::format("self-calibration of map {}", i + 1),
                                   ToText(record.calibrations[i]));
  }
  finished.warnings = info.warnings;
  return finished;
}

void PrintSummary(const FinishedRun& finished, const std::filesystem::path& output) {
  const EvaluationResult& result = finished.evaluation.final_trajectory;
  std::cout << fmt::format("status      {}\ncoverage    {:.1f} % of {} frames\n",
                           Name(result.status), 100.0 * result.coverage.coverage,
                           finished.run.frames.size());
  if (result.ate_m) {
    std::cout << fmt::format("ATE RMSE    {:.4f} m after {} alignment\n", result.ate_m->rmse,
                             Name(result.options.alignment));
  } else if (!finished.ground_truth.empty()) {
    std::cout << fmt::format("ATE RMSE    none: {}\n", result.no_errors_reason);
  }
  for (std::size_t i = 1; i < finished.run.refusals.size(); ++i) {
    const auto refusal = static_cast<FrameRefusal>(i);
    if (finished.run.refusals[i] > 0) {
      std::cout << fmt::format("refused     {} x {}: {}\n", finished.run.refusals[i], Name(refusal),
                               Explain(refusal));
    }
  }
  std::cout << fmt::format("report      {}\n", (output / "report.html").string());
}

void Run(const RunArguments& arguments) {
  ProgramOptions options = EffectiveOptions(arguments);
  arguments.files.maps.Check();
  const std::vector<ImageDistortion> distortions = Distortions(arguments);
  auto sequence = OpenSequence(arguments.sequence.source, arguments.sequence.Options());
  PrepareOutputFolder(arguments.output);
  RunLog log(arguments.output / "log.txt");
  const SequenceInfo info = sequence->info();
  log.Info(fmt::format("{}: {} ({}), camera {}", arguments.sequence.source, info.name,
                       FormatName(info.format), info.camera->source));
  for (const std::string& warning : info.warnings) log.Warning(warning);
  DisableImageThreads();

  const SlamRun run =
      RunSlam(std::move(sequence), options, arguments.output, arguments.files, log, distortions);
  const FinishedRun finished = Conclude(arguments, info, run.record, options);
  WriteRunOutputs(finished, arguments.output, options.outputs);
  PrintSummary(finished, arguments.output);
  log.Info(fmt::format("status {}", Name(finished.evaluation.final_trajectory.status)));
  if (!run.save_error.empty()) throw InputError(run.save_error);
  if (!log.WriteError().empty()) throw InputError(log.WriteError());
  const RunStatus status = finished.evaluation.final_trajectory.status;
  if (status == RunStatus::kFailInit || status == RunStatus::kFailLost) {
    throw CLI::RuntimeError(kNoTrajectory);
  }
}

}  // namespace

void AddRunCommand(CLI::App& app) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* command =
      app.add_subcommand("run", "From a sequence to a trajectory, a map and a report");
  arguments->sequence.AddTo(*command);
  command->add_option("--output", arguments->output, "Folder for all results")->required();
  command->add_option("--features", arguments->features, "Kind of features: orb (default) or lift");
  command
      ->add_option("--weights", arguments->weights,
                   "LIFT weights (.safetensors; default: those that ship)")
      ->type_name("FILE");
  command
      ->add_option("--vocabulary", arguments->vocabulary,
                   "Visual words for loop closing (default: the one shipped for the features)")
      ->type_name("FILE");
  arguments->config.AddTo(*command);
  command->add_option("--seed", arguments->seed, "Of everything random (default 0)");
  command->add_option("--mode", arguments->mode, "sequential or threaded (default)");
  command->add_option("--save-map", arguments->files.maps.save, "Keep the run's maps (.liftmap)")
      ->type_name("FILE");
  command
      ->add_option("--load-map", arguments->files.maps.load, "Go on in the maps of an earlier run")
      ->type_name("FILE");
  command->add_flag("--localization-only", arguments->files.maps.localization_only,
                    "Poses in the loaded maps alone, which are not changed");
  command
      ->add_option(
          "--feature-cache", arguments->files.feature_cache,
          "Folder that keeps the features of every image (0.1 MB each with ORB, 0.5 MB with "
          "LIFT): further runs find them there")
      ->type_name("FOLDER");
  command
      ->add_option("--distort", arguments->distort,
                   "Damage to every image before anything else, such as gamma=0.25, q1, "
                   "salt-pepper=0.02 or several with commas ('lift_slam distort --help')")
      ->type_name("SPEC");
  command->footer(
      "Examples:\n"
      "  lift_slam run kitti/sequences/00 --output runs/00\n"
      "  lift_slam run drive.mp4 --camera camera.yaml --output runs/drive --frames 0:500:2\n"
      "  lift_slam run images/ --camera camera.yaml --output runs/x --set "
      "slam.orb.max_features=3000\n"
      "  lift_slam run kitti/sequences/00 --features lift --output runs/l\n"
      "  lift_slam run lap1/ --save-map park.liftmap --output runs/lap1\n"
      "  lift_slam run lap2/ --load-map park.liftmap --localization-only --output runs/lap2\n"
      "Exit codes: 0 done, 1 bad input, 3 ran but found no usable trajectory (all files written).");
  command->callback([arguments] { Run(*arguments); });
}

}  // namespace lift_slam
