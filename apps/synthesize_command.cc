#include "apps/synthesize_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "apps/progress_bar.h"
#include "lift_slam/testing/synthetic_sequence.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr double kDriveFrameRateHz = 10.0;  // as KITTI
constexpr double kHandFrameRateHz = 30.0;

struct SynthesizeArguments {
  std::filesystem::path output;
  SyntheticPath path = SyntheticPath::kStreetDrive;
  SequenceLayout layout = SequenceLayout::kKittiOdometry;
  int num_frames = 120;
  std::uint64_t seed = 1;
  std::optional<double> frame_rate_hz;
};

// What the words of --path and --layout stand for.
std::vector<std::pair<std::string, SyntheticPath>> PathNames() {
  std::vector<std::pair<std::string, SyntheticPath>> names;
  for (const SyntheticPath path :
       {SyntheticPath::kStreetDrive, SyntheticPath::kRoomSway, SyntheticPath::kRoomLoop,
        SyntheticPath::kRoomRotation, SyntheticPath::kRoomStill}) {
    names.emplace_back(Name(path), path);
  }
  return names;
}

std::vector<std::pair<std::string, SequenceLayout>> LayoutNames() {
  return {{"kitti", SequenceLayout::kKittiOdometry},
          {"tum", SequenceLayout::kTumRgbd},
          {"euroc", SequenceLayout::kEuroc}};
}

// An option whose values are names; anything else is refused with the list of them.
template <class Enum>
void AddNames(CLI::App& command, const std::string& option, Enum& value,
              const std::vector<std::pair<std::string, Enum>>& names, const std::string& comment) {
  std::vector<std::string> words;
  std::string initial;
  for (const auto& [word, meaning] : names) {
    words.push_back(word);
    if (meaning == value) initial = word;
  }
  command
      .add_option_function<std::string>(
          option,
          [&value, names](const std::string& word) {
            for (const auto& [name, meaning] : names) {
              if (name == word) value = meaning;
            }
          },
          comment)
      ->check(CLI::IsMember(words))
      ->default_str(initial);
}

SyntheticSequenceOptions SequenceOptionsFrom(const SynthesizeArguments& arguments) {
  SyntheticSequenceOptions options;
  const bool drive = arguments.path == SyntheticPath::kStreetDrive;
  options.path = arguments.path;
  options.num_frames = arguments.num_frames;
  options.seed = arguments.seed;
  options.frame_rate_hz =
      arguments.frame_rate_hz.value_or(drive ? kDriveFrameRateHz : kHandFrameRateHz);
  const double path_s = PathDurationS(arguments.path);
  if ((options.num_frames - 1) / options.frame_rate_hz > path_s) {
    throw InputError(
        fmt::format("--frames {}: the path {} ends after {:.0f} s, which is {:.0f} frames at "
                    "{} frames/s",
                    options.num_frames, Name(options.path), path_s,
                    std::floor(path_s * options.frame_rate_hz) + 1, options.frame_rate_hz));
  }
  return options;
}

// Images of an older sequence would become part of the new one.
void CheckOutputIsFree(const std::filesystem::path& folder) {
  std::error_code error;
  if (std::filesystem::exists(folder, error) && !std::filesystem::is_directory(folder, error)) {
    throw InputError(fmt::format("{}: is a file, expected a folder", folder.string()));
  }
  if (std::filesystem::is_directory(folder, error) && !std::filesystem::is_empty(folder, error)) {
    throw InputError(
        fmt::format("{}: the folder is not empty; expected a new or empty one", folder.string()));
  }
}

void Synthesize(const SynthesizeArguments& arguments) {
  const SyntheticSequenceOptions options = SequenceOptionsFrom(arguments);
  CheckOutputIsFree(arguments.output);
  ProgressBar bar;
  Progress progress{0, options.num_frames, "rendering", kNoMap, 0};
  const WrittenSequence written =
      WriteSyntheticSequence(arguments.output, arguments.layout, options, [&](int num_written) {
        progress.frames_done = num_written;
        bar.Update(progress);
      });
  progress.state = "rendered";
  bar.Finish(progress);
  std::cout << fmt::format("sequence    {}\ntruth       {}\n", written.folder.string(),
                           written.ground_truth.string());
}

}  // namespace

void AddSynthesizeCommand(CLI::App& app) {
  const auto arguments = std::make_shared<SynthesizeArguments>();
  CLI::App* command = app.add_subcommand(
      "synthesize", "Render a textured sequence with exact ground truth, to try the program on");
  command->add_option("--output", arguments->output, "New or empty folder for the sequence")
      ->required();
  AddNames(*command, "--path", arguments->path, PathNames(), "How the camera moves");
  AddNames(*command, "--layout", arguments->layout, LayoutNames(), "Layout of the files");
  command->add_option("--frames", arguments->num_frames, "Number of images")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", arguments->seed, "Of the textures, the layout and the noise")
      ->capture_default_str();
  command
      ->add_option("--frame-rate-hz", arguments->frame_rate_hz,
                   "Images a second (default: 10 for street_drive, else 30)")
      ->check(CLI::Range(0.1, 1000.0));
  command->footer(
      "Example:\n"
      "  lift_slam synthesize --output runs/street --frames 120\n"
      "  lift_slam run runs/street/sequences/00 --output runs/street_results");
  command->callback([arguments] { Synthesize(*arguments); });
}

}  // namespace lift_slam
