#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lift_slam {

struct BenchmarkSequence {
  std::string name;              // "00", "MH_01"
  std::string dataset;           // "kitti" or "euroc": which variant of a preset fits
  std::filesystem::path folder;  // empty: not found
  std::filesystem::path rival;   // another that fits as well; empty: none
};

// The suite's sequences in the order of the tables, those that are missing included. Looks below
// `data` wherever the datasets' own archives put them.
std::vector<BenchmarkSequence> FindBenchmarkSequences(const std::string& suite,
                                                      const std::filesystem::path& data);

// Images of a sequence of KITTI odometry ("00") or EuRoC ("MH_01", cam0) as published; 0: not
// known.
int PublishedFrames(const std::string& sequence);

// SHA-256 of what a sequence's folder holds: names and sizes of all files, and the content of the
// small text files (calibration, times, truth); for KITTI of ../../poses/NAME.txt too. The same
// wherever the folder lies, so that results outlive a move of the data.
std::string SequenceIdentity(const std::filesystem::path& folder);

// The program's revision; of a build that differs from it, or of none, the program itself too.
std::string ProgramIdentity();

// A system: a file of options, and remarks in its first lines ("# title: ...", "# skip: 00 06",
// "# make: ...": how its weights are made).
struct BenchmarkSystem {
  std::string name, title;
  std::filesystem::path config;
  std::vector<std::string> skipped_sequences;  // it was trained with them
  std::string making;                          // of its weights; empty: nothing is said
  std::vector<std::string> settings;           // key=value over the file
};

// The preset for a dataset: NAME.DATASET.yaml where it exists, else NAME.yaml; or a file. Throws
// InputError naming the nearest known preset.
BenchmarkSystem FindBenchmarkSystem(const std::string& name, const std::string& dataset);

}  // namespace lift_slam
