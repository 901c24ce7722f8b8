#pragma once

#include <filesystem>

namespace lift_slam {

// Makes the folder when it does not exist and tries that files can be written there, before a run
// begins. Files of an earlier run stay until each is replaced, but for its result.json, which says
// that a run is complete. Throws InputError with one sentence.
void PrepareOutputFolder(const std::filesystem::path& folder);

}  // namespace lift_slam
