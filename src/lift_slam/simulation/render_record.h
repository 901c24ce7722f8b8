#pragma once

#include <filesystem>
#include <string>

#include "lift_slam/util/option_root.h"

namespace lift_slam {

// Writes all that goes into a sequence beside it, or, when such a file is there, checks that it
// says the same, so that the frames already there may stay. Throws InputError naming the first
// option that differs, with both values.
void WriteOrCheckRenderRecord(const std::filesystem::path& path, const OptionRoot& inputs);

}  // namespace lift_slam
