#pragma once

#include <memory>
#include <string>

#include "lift_slam/datasets/sequence.h"

namespace lift_slam {

// A video file. Times come from options.frame_rate_hz when given, else from the container where
// it has increasing ones, else from its nominal rate. Throws InputError when it cannot be opened.
std::unique_ptr<Sequence> OpenVideoSequence(const std::string& file,
                                            const SequenceOptions& options);

// A camera by index ("0"), device ("/dev/video0") or URL. Times are those of arrival: the system
// clock at the first image, a steady clock from there. Throws InputError when none can be opened.
std::unique_ptr<Sequence> OpenLiveSequence(const std::string& source,
                                           const SequenceOptions& options);

}  // namespace lift_slam
