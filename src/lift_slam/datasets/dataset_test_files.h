#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/datasets/sequence.h"
#include "lift_slam/testing/temporary_folder.h"
#include "lift_slam/util/input_error.h"

// Small sequences on disk, for the tests of this folder.
namespace lift_slam {

constexpr char kTestCamera[] =
    "model: pinhole\nwidth: 12\nheight: 8\nfx: 10\nfy: 10\ncx: 5.5\ncy: 3.5\n";
constexpr char kKittiCalibration[] =
    "P0: 10 0 5.5 0 0 10 3.5 0 0 0 1 0\nP2: 10 0 5.5 -5 0 10 3.5 0 0 0 1 0\n";

class TestFolder : public TemporaryFolder {
 public:
  // A grey 12 x 8 image whose top-left pixel is `value`.
  std::filesystem::path WriteImage(const std::string& name, int value = 0, int width = 12,
                                   int height = 8) const {
    const std::filesystem::path file = path() / name;
    std::filesystem::create_directories(file.parent_path());
    cv::Mat image(height, width, CV_8UC1);
    for (int i = 0; i < width * height; ++i) {
      image.at<unsigned char>(i / width, i % width) = static_cast<unsigned char>(value + i * 7);
    }
    cv::imwrite(file.string(), image);
    return file;
  }
};

inline std::vector<SequenceFrame> ReadAll(Sequence& sequence) {
  std::vector<SequenceFrame> frames;
  while (auto frame = sequence.Next()) frames.push_back(std::move(*frame));
  return frames;
}

// The message of the InputError that `call` throws; "no error" when it throws none.
template <class Call>
std::string InputErrorOf(Call call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

inline std::string OpenError(const std::filesystem::path& path,
                             const SequenceOptions& options = {}) {
  return InputErrorOf([&] { OpenSequence(path.string(), options); });
}

// Real sequences; nothing when they are not on this machine.
inline std::optional<std::filesystem::path> RealData() {
  std::filesystem::path path;
  if (const char* data = std::getenv("LIFT_SLAM_DATA")) {
    path = data;
  } else if (const char* source = std::getenv("LIFT_SLAM_SOURCE_DIR")) {
    path = std::filesystem::path(source) / "../shared/data";
  }
  if (path.empty() || !std::filesystem::is_directory(path)) return std::nullopt;
  return path;
}

}  // namespace lift_slam
