#include "lift_slam/datasets/sequence_setup.h"

#include <fmt/format.h>

#include "lift_slam/datasets/camera_file.h"
#include "lift_slam/datasets/frame_rate.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {

void CheckSequenceOptions(const SequenceOptions& options) {
  if (options.first < 0 || options.step < 1 || options.last < -1 ||
      (options.last >= 0 && options.last < options.first)) {
    throw InputError(fmt::format(
        "the range of frames {}:{}:{} is not valid; expected FIRST:LAST:STEP with 0 <= FIRST <= "
        "LAST (or LAST -1 for the end) and STEP >= 1",
        options.first, options.last, options.step));
  }
  if (options.frame_rate_hz != 0.0 && !IsFrameRate(options.frame_rate_hz)) {
    throw InputError(fmt::format("the frame rate is {}, expected {} to {} frames/s",
                                 options.frame_rate_hz, kMinFrameRateHz, kMaxFrameRateHz));
  }
}

bool IsSelected(std::int64_t frame_index, const SequenceOptions& options) {
  return frame_index >= options.first && (options.last < 0 || frame_index <= options.last) &&
         (frame_index - options.first) % options.step == 0;
}

std::optional<Camera> ReadGivenCamera(const SequenceOptions& options) {
  if (!options.camera_file) return std::nullopt;
  return ReadCameraFile(*options.camera_file, options.camera_name);
}

std::optional<Camera> FinishCamera(std::optional<Camera> camera, const ImageSize& size,
                                   double frame_rate_hz, const std::string& source,
                                   const std::string& searched, const SequenceOptions& options) {
  if (!camera) {
    if (options.calibration == CalibrationNeed::kOptional) return std::nullopt;
    throw InputError(fmt::format(
        "{}: no camera calibration was found (looked for {}); give one with --camera FILE, for "
        "example a file with the line {} (docs/datasets.md lists the formats)",
        source, searched, kCameraFileExample));
  }
  PinholeIntrinsics& pinhole = camera->pinhole;
  if (pinhole.width == 0) pinhole.width = size.width;
  if (pinhole.height == 0) pinhole.height = size.height;
  if (pinhole.width != size.width || pinhole.height != size.height) {
    throw InputError(fmt::format("{}: is {}x{} pixels, but the calibration {} is for {}x{}",
                                 size.image, size.width, size.height, camera->source, pinhole.width,
                                 pinhole.height));
  }
  if (camera->frame_rate_hz <= 0.0) camera->frame_rate_hz = frame_rate_hz;
  CheckCalibration(*camera);
  return camera;
}

std::filesystem::path NormalPath(const std::string& source) {
  std::filesystem::path path = std::filesystem::absolute(source).lexically_normal();
  if (!path.has_filename() && path.has_relative_path()) path = path.parent_path();
  return path;
}

}  // namespace lift_slam
