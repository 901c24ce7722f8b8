#include "apps/sequence_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "lift_slam/datasets/sequence_format.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

// A part of the range; `fallback` when it is empty.
std::int64_t RangePart(const std::string& range, std::string_view part, std::int64_t fallback,
                       std::int64_t least) {
  if (part.empty()) return fallback;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
  if (error != std::errc() || end != part.data() + part.size() || value < least) {
    throw InputError(fmt::format(
        "--frames '{}': '{}' is not a whole number of at least {}; expected FIRST:LAST:STEP", range,
        part, least));
  }
  return value;
}

void ParseRange(const std::string& range, SequenceOptions& options) {
  std::vector<std::string_view> parts;
  std::string_view rest = range;
  while (true) {
    const std::size_t colon = rest.find(':');
    parts.push_back(rest.substr(0, colon));
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (parts.size() > 3) {
    throw InputError(fmt::format("--frames '{}': expected FIRST:LAST:STEP", range));
  }
  parts.resize(3);
  options.first = RangePart(range, parts[0], 0, 0);
  options.last = RangePart(range, parts[1], -1, 0);
  options.step = RangePart(range, parts[2], 1, 1);
  if (options.last >= 0 && options.last < options.first) {
    throw InputError(fmt::format("--frames '{}': the last frame is before the first", range));
  }
}

}  // namespace

void SequenceArguments::AddTo(CLI::App& command) {
  command.add_option("SEQUENCE", source, "Folder, video file, camera index or URL")->required();
  command.add_option("--format", format,
                     "kitti, kitti_raw, euroc, tum_rgbd, tum_mono, images, video or live "
                     "(default: found out from the folder)");
  command.add_option("--camera", camera_file,
                     "Calibration file: own YAML, OpenCV, Kalibr, ORB-SLAM or COLMAP cameras.txt");
  command.add_option("--ground-truth", ground_truth_file, "Poses: TUM, KITTI or EuRoC csv");
  command.add_option("--frames", frames, "Part of the input, LAST included: FIRST:LAST:STEP");
  command.add_option("--camera-name", camera_name,
                     "Which camera of a rig, such as image_2 or cam1");
  command.add_option("--frame-rate-hz", frame_rate_hz, "Rate of images without timestamps");
}

SequenceOptions SequenceArguments::Options() const {
  SequenceOptions options;
  if (!format.empty()) options.format = ParseFormatName(format);
  if (!camera_file.empty()) options.camera_file = camera_file;
  if (!ground_truth_file.empty()) options.ground_truth_file = ground_truth_file;
  if (!frames.empty()) ParseRange(frames, options);
  options.frame_rate_hz = frame_rate_hz;
  options.camera_name = camera_name;
  return options;
}

}  // namespace lift_slam
