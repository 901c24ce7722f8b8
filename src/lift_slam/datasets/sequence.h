#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lift_slam/camera/camera.h"
#include "lift_slam/datasets/ground_truth.h"
#include "lift_slam/datasets/sequence_format.h"
#include "lift_slam/image/image.h"

namespace lift_slam {

// Why a frame has no image.
enum class ImageProblem { kNone, kUnreadable, kSizeDiffers, kTimestampNotIncreasing };

struct SequenceFrame {
  // Position in the source, skipped and unreadable frames included. Where the dataset numbers its
  // images (KITTI, TUM-mono) it is that number.
  std::int64_t frame_index = 0;
  std::int64_t timestamp_ns = 0;
  std::optional<GrayImage> image;  // nothing exactly when `problem` is not kNone
  ImageProblem problem = ImageProblem::kNone;
  std::string problem_text;  // one sentence that names the file; empty without a problem
};

// Which frame of a sequence, and when.
struct FrameStamp {
  std::int64_t frame_index = 0, timestamp_ns = 0;
};

struct SequenceInfo {
  std::string name;  // last part of the path
  SequenceFormat format = SequenceFormat::kImageFolder;
  std::filesystem::path path;
  // Frames that Next will hand out, those without image included. Nothing for a live camera; for
  // a video what its container claims.
  std::optional<std::int64_t> num_frames;
  // Calibration of the images as handed out, its size filled in from the images when the file
  // gives none, its frame rate from the timestamps. Nothing only with CalibrationNeed::kOptional.
  std::optional<Camera> camera;
  std::optional<GroundTruth> ground_truth;
  std::vector<std::string> warnings;  // one sentence each
  // Of all frames that Next will hand out, in that order. Empty for videos and live cameras, whose
  // times come with the frames.
  std::vector<FrameStamp> frames;
};

// Images in the order of the recording. Not safe for use from two threads at once.
class Sequence {
 public:
  virtual ~Sequence() = default;
  // The next frame; nothing at the end. A bad image is a frame without image, never an exception.
  virtual std::optional<SequenceFrame> Next() = 0;
  virtual const SequenceInfo& info() const = 0;
};

enum class CalibrationNeed { kRequired, kOptional };

struct SequenceOptions {
  std::optional<SequenceFormat> format;              // nothing: found out from the path
  std::optional<std::filesystem::path> camera_file;  // instead of the sequence's own calibration
  // Instead of the sequence's own truth: TUM, KITTI (12 or 13 columns) or EuRoC csv.
  std::optional<std::filesystem::path> ground_truth_file;
  CalibrationNeed calibration = CalibrationNeed::kRequired;
  // Range of frame indices, `last` included and -1 for the end; every step-th of them.
  std::int64_t first = 0;
  std::int64_t last = -1;
  std::int64_t step = 1;
  // Of images and videos without times; 0: the camera file's or the video's, else nominal with a
  // warning (10 for KITTI, 30 else).
  double frame_rate_hz = 0.0;
  // Which camera of a rig: image_0 to image_3, image_00 to image_03, cam0, cam1. Empty: the first.
  std::string camera_name;
};

// Opens a folder, a video file, or a live camera (an index such as "0", "/dev/video0" or a URL).
// Reads the first image. Throws InputError with one sentence when there is no such thing, its
// layout is unknown, an index file is malformed, no image can be read, calibration is missing, or
// the calibration is of another image size.
std::unique_ptr<Sequence> OpenSequence(const std::string& source,
                                       const SequenceOptions& options = {});

}  // namespace lift_slam
