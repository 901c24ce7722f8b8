#pragma once

#include <cstdint>
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

// Reads the truth that options or the list name, and brings it to the camera that runs. `images`
// are all those with a valid time. A truth of the sequence's own that shares no time with the
// images is left out with a warning; one given by options throws InputError.
std::optional<GroundTruth> LoadGroundTruth(const ImageList& list,
                                           const std::vector<ListedImage>& images,
                                           const SequenceOptions& options,
                                           std::vector<std::string>& warnings);

// "<path>" without trailing slash, absolute.
std::filesystem::path NormalPath(const std::string& source);

}  // namespace lift_slam
