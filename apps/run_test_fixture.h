#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/program_for_test.h"
#include "lift_slam/testing/synthetic_sequence.h"

namespace lift_slam {

// A folder with small rendered sequences, and calls of `lift_slam run` on them.
class RunCommand : public testing::Test {
 protected:
  RunCommand();
  ~RunCommand() override;

  // A rendered sequence of 480 x 360 pixels below folder_/data. Gives the folder to run on.
  std::filesystem::path Render(SequenceLayout layout, int num_frames,
                               SyntheticPath path = SyntheticPath::kRoomSway) const;
  // Sorted by name.
  static std::vector<std::filesystem::path> FilesIn(const std::filesystem::path& folder);
  // `lift_slam run SEQUENCE --output output_ ARGUMENTS`.
  Outcome Run(const std::filesystem::path& sequence, const std::string& arguments = "") const;

  // The run took place and all files are there. Gives result.json.
  nlohmann::json ExpectAllOutputs(const Outcome& outcome, int exit_code) const;
  // Exit code 1 and nothing printed but one sentence that holds `parts`.
  static void ExpectOneSentence(const Outcome& outcome, const std::vector<std::string>& parts);

  const std::filesystem::path folder_, output_ = folder_ / "results";
};

}  // namespace lift_slam
