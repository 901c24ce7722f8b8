#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "lift_slam/camera/camera.h"
#include "lift_slam/datasets/image_list.h"
#include "lift_slam/datasets/sequence.h"

namespace lift_slam {

// Parts of opening a sequence that image lists and videos share.

// Throws InputError when the range of frames or the rate makes no sense.
void CheckSequenceOptions(const SequenceOptions& options);

// Whether first, last and step select this frame.
bool IsSelected(std::int64_t frame_index, const SequenceOptions& options);

// The calibration of options.camera_file; nothing when none is given.
std::optional<Camera> ReadGivenCamera(const SequenceOptions& options);

struct ImageSize {
  int width = 0, height = 0;
  std::string image;  // which image it is of, for messages
};

// Fills in size and rate where the calibration has none. Throws InputError when there is no
// calibration but one is required (naming where it was looked for), or when it is of another
// image size.
std::optional<Camera> FinishCamera(std::optional<Camera> camera, const ImageSize& size,
                                   double frame_rate_hz, const std::string& source,
                                   const std::string& searched, const SequenceOptions& options);

struct TimeRange {
  std::int64_t first_ns = 0, last_ns = 0;
};

// The frames that a truth is paired with.
struct TruthFrames {
  std::optional<std::int64_t> count;  // nothing: unknown
  // The time of a frame; nothing when there is none of this index.
  std::function<std::optional<std::int64_t>(std::int64_t frame_index)> time_ns;
  std::optional<TimeRange> range;  // from the first to the last; nothing: unknown
};

// All images of a list that have a valid time.
TruthFrames FramesOf(const std::vector<ListedImage>& images);

// Reads the truth that options or the list name, and brings it to the camera that runs. A truth of
// the sequence's own that shares no time with the frames is left out with a warning; one given by
// options throws InputError. Frames of unknown range are taken to share some.
std::optional<GroundTruth> LoadGroundTruth(const ImageList& list, const TruthFrames& frames,
                                           const SequenceOptions& options,
                                           std::vector<std::string>& warnings);

// "<path>" without trailing slash, absolute.
std::filesystem::path NormalPath(const std::string& source);

}  // namespace lift_slam
