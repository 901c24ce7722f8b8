#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lift_slam {

// Tables over many runs. Runs with the same dataset, sequence, configuration, distortion, settings
// (seed apart), trajectory, frame of the ground truth and alignment form one row: mean, median, min
// and max over the OK and PARTIAL runs, "k/n" beside them. X: no run succeeded; "-": skipped on
// purpose (status SKIPPED); "partial": some frames have no pose.
struct RunReport {
  std::string markdown;  // table and settings footer
  std::string csv;       // one row a group, all statistics; empty cells where nothing was measured
};

// The result.json files below a folder, sorted by path; a file stands for itself. Throws
// InputError when there is none.
std::vector<std::filesystem::path> FindResultFiles(const std::filesystem::path& path);

// Throws InputError with file and key when a file is no JSON or lacks a field.
RunReport BuildReport(const std::vector<std::filesystem::path>& result_files);

}  // namespace lift_slam
