#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lift_slam/datasets/image_list_sequence.h"
#include "lift_slam/datasets/sequence.h"
#include "lift_slam/datasets/sequence_setup.h"
#include "lift_slam/datasets/video_sequence.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

SequenceFormat ChooseFormat(const std::string& source, const SequenceOptions& options) {
  if (options.format) return *options.format;
  const FormatDetection detection = DetectFormat(source);
  if (detection.format) return *detection.format;
  throw InputError(fmt::format("{}: is no sequence of a known layout ({})", source,
                               fmt::join(detection.reasons, "; ")));
}

std::unique_ptr<Sequence> Open(const std::string& source, const SequenceOptions& options) {
  const SequenceFormat format = ChooseFormat(source, options);
  if (format == SequenceFormat::kVideo) return OpenVideoSequence(source, options);
  if (format == SequenceFormat::kLiveCamera) return OpenLiveSequence(source, options);
  return OpenImageListSequence(source, format, options);
}

}  // namespace

std::unique_ptr<Sequence> OpenSequence(const std::string& source, const SequenceOptions& options) {
  CheckSequenceOptions(options);
  try {
    return Open(source, options);
  } catch (const std::filesystem::filesystem_error& error) {
    throw InputError(fmt::format("{}: {}", source, error.code().message()));  // no permission
  }
}

}  // namespace lift_slam
