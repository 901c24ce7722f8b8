#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lift_slam::training {

// Runs a program with its arguments, its output going to the end of a file, and waits for it.
// Throws InputError naming the program when it is not installed, and naming the file when it does
// not end well.
void RunProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log);

}  // namespace lift_slam::training
