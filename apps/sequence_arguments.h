#pragma once

#include <string>

#include "lift_slam/datasets/sequence.h"

namespace CLI {
class App;
}

namespace lift_slam {

// The arguments that choose an input: a path, camera index or URL, and how to read it.
struct SequenceArguments {
  std::string source;
  std::string format;  // empty: found out from the folder
  std::string camera_file;
  std::string ground_truth_file;
  std::string frames;  // "FIRST:LAST:STEP", each may be left out
  std::string camera_name;
  double frame_rate_hz = 0.0;

  // Adds them to a command; *this must outlive it.
  void AddTo(CLI::App& command);
  // Throws InputError for an unknown format or a malformed range.
  SequenceOptions Options() const;
};

}  // namespace lift_slam
