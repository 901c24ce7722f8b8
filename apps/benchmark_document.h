#pragma once

#include <filesystem>
#include <vector>

namespace lift_slam {

// Writes a Markdown document of the stored results of several benchmarks, a chapter each: its
// tables, where they come from (processors, revision, dates, SHA-256 of data, weights and settings)
// and its figures, which are written into the folder `file` without its extension (those of an
// earlier document are removed, once all chapters are made). The same results give the same
// document. Throws InputError for a folder that is no benchmark or has no finished run.
void WriteBenchmarkDocument(const std::vector<std::filesystem::path>& folders,
                            const std::filesystem::path& publications,
                            const std::filesystem::path& file);

}  // namespace lift_slam
