#include "apps/evaluate_command.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/evaluation_input.h"
#include "lift_slam/evaluation/evaluate.h"
#include "lift_slam/evaluation/result_json.h"
#include "lift_slam/evaluation/result_table.h"
#include "lift_slam/geometry/trajectory_io.h"
#include "lift_slam/util/file.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

struct Arguments {
  EvaluationFiles files;
  EvaluationOptions options;
  std::optional<double> max_time_difference_ms;  // nothing: by the kind of the reference
  std::string dataset, sequence;
  std::string output;
  bool json = false;
};

template <class Names>
std::vector<std::string> ToStrings(const Names& names) {
  return {std::begin(names), std::end(names)};
}

// An option whose values are the names of an enum class.
template <class Enum>
void AddEnum(CLI::App& command, const std::string& option, Enum& value,
             std::span<const std::string_view> names, const std::string& comment) {
  command
      .add_option_function<std::string>(
          option,
          [&value, names](const std::string& name) {
            const auto it = std::find(names.begin(), names.end(), name);
            value = static_cast<Enum>(it - names.begin());
          },
          comment)
      ->check(CLI::IsMember(ToStrings(names)))
      ->default_str(std::string(names[static_cast<std::size_t>(value)]));
}

void AddFileOptions(CLI::App& command, Arguments& arguments) {
  EvaluationFiles& files = arguments.files;
  const auto formats = CLI::IsMember(ToStrings(kTrajectoryFormatNames));
  command.add_option("--reference", files.reference, "Reference trajectory (ground truth)")
      ->required();
  command.add_option("--estimate", files.estimate, "Trajectory to judge")->required();
  command.add_option("--format", files.format, "Format of the estimate")
      ->check(formats)
      ->capture_default_str();
  command.add_option("--reference-format", files.reference_format, "Format of the reference")
      ->check(formats)
      ->capture_default_str();
  command.add_option("--times", files.times,
                     "Times of all frames in seconds, one a line (KITTI times.txt): gives KITTI "
                     "poses their times, and coverage its frames");
  command.add_option("--sensor-yaml", files.sensor_yaml,
                     "EuRoC cam0/sensor.yaml: moves a reference of the body to the camera");
  command.add_option("--dataset", arguments.dataset, "Name for the tables");
  command.add_option("--sequence", arguments.sequence,
                     "Name for the tables (default: the path of the reference)");
  command.add_option("--output", arguments.output,
                     "Folder for result.json and the aligned trajectories");
  command.add_flag("--json", arguments.json, "Print result.json instead of tables");
}

void AddMetricOptions(CLI::App& command, Arguments& arguments) {
  EvaluationOptions& options = arguments.options;
  AddEnum(command, "--alignment", options.alignment, kAlignmentModeNames,
          "How the estimate is laid over the reference");
  AddEnum(command, "--associate", options.association.method, kAssociationMethodNames,
          "Pair poses by frame index or by time");
  command.add_option("--max-time-difference-ms", arguments.max_time_difference_ms,
                     "Poses further apart are no pair (default: 10 for EuRoC ground truth, else "
                     "20)");
  command.add_option("--offset-s", options.association.offset_s,
                     "Added to the timestamps of the estimate");
  command.add_flag("--interpolate", options.association.interpolate,
                   "Interpolate the denser trajectory at the stamps of the sparser one");
  command.add_option("--align-first", options.align_first,
                     "Fit the alignment to the first N pairs (default: all)");
  AddEnum(command, "--gt-frame", options.gt_frame, kGroundTruthFrameNames,
          "Compare with positions of the camera, or of the body as in EuRoC's files");
  command.add_option("--frames-total", options.frames_total,
                     "Number of input frames, for the coverage (default: from --times or the "
                     "reference)");
  command.add_option("--rpe-delta", options.rpe.delta, "Distance of the poses of an RPE pair")
      ->capture_default_str();
  AddEnum(command, "--rpe-unit", options.rpe.unit, kRpeUnitNames, "Unit of --rpe-delta");
  AddEnum(command, "--rpe-pairs", options.rpe.pairs, kRpePairsNames,
          "All RPE pairs, or those that do not overlap");
  AddEnum(command, "--rpe-path", options.rpe.path_source, kRpePathSourceNames,
          "Whose path is measured when the unit is metres");
}

std::string DatasetOf(TrajectoryFormat reference_format) {
  switch (reference_format) {
    case TrajectoryFormat::kKitti:
    case TrajectoryFormat::kKittiIndexed:
      return "kitti";
    case TrajectoryFormat::kEurocCsv:
      return "euroc";
    default:
      return "";
  }
}

void WriteOutput(const EvaluationResult& result, const std::filesystem::path& folder) {
  CreateFolder(folder);
  WriteTextAtomically(folder / "result.json", ToJson(result).dump(2) + "\n");
  const Trajectory& aligned = result.aligned_estimate;
  if (aligned.empty()) return;
  WriteTrajectory(aligned, TrajectoryFormat::kTum, folder / "aligned.tum");
  if (aligned.front().frame_index >= 0) {
    WriteTrajectory(aligned, TrajectoryFormat::kKitti, folder / "aligned_kitti.txt");
  }
}

void RunEvaluation(Arguments arguments) {
  EvaluationOptions& options = arguments.options;
  const EvaluationInput input = LoadEvaluationInput(arguments.files, options);
  for (const std::string& warning : input.warnings) {
    std::cerr << "lift_slam: warning: " << warning << '\n';
  }
  const bool euroc = input.reference_format == TrajectoryFormat::kEurocCsv;
  options.association.max_time_difference_ms = arguments.max_time_difference_ms.value_or(
      euroc ? kEurocMaxTimeDifferenceMs : kTumMaxTimeDifferenceMs);
  if (input.reference.empty()) {
    throw InputError(arguments.files.reference + ": the reference holds no pose");
  }
  EvaluationResult result = Evaluate(input.estimate, input.reference, options);
  result.dataset =
      arguments.dataset.empty() ? DatasetOf(input.reference_format) : arguments.dataset;
  result.sequence = arguments.sequence.empty() ? arguments.files.reference : arguments.sequence;
  if (!arguments.output.empty()) WriteOutput(result, arguments.output);
  std::cout << (arguments.json ? ToJson(result).dump(2) + "\n" : FormatResult(result));
}

}  // namespace

void AddEvaluateCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("evaluate", "Measure a trajectory file against a reference file");
  const auto arguments = std::make_shared<Arguments>();
  AddFileOptions(*command, *arguments);
  AddMetricOptions(*command, *arguments);
  command->footer(
      "Examples:\n"
      "  lift_slam evaluate --reference poses/00.txt --estimate runs/00/trajectory.tum --times "
      "sequences/00/times.txt\n"
      "  lift_slam evaluate --reference mav0/state_groundtruth_estimate0/data.csv --estimate "
      "trajectory.tum --output evaluation");
  command->callback([arguments] { RunEvaluation(*arguments); });
}

}  // namespace lift_slam
