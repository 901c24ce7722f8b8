#pragma once

#include <cstdint>
#include <span>

namespace lift_slam {

// False for a PNG or JPEG file that ends before its end marker, as a copy or download cut short
// does: decoders fill the missing part of a JPEG with grey and report success. True for every
// other content, also for one that is no image.
bool IsCompleteImageFile(std::span<const std::uint8_t> file);

}  // namespace lift_slam
