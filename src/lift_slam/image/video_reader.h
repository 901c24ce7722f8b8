#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "lift_slam/image/image.h"

namespace lift_slam {

// Frames of a video file or camera, in grey. Hides OpenCV's capture.
class VideoReader {
 public:
  enum class ReadStatus { kImage, kUndecodable, kEnd };

  // Nothing when it cannot be opened; `why` (when given) then holds one sentence.
  // OpenCamera takes an index ("0"), a device ("/dev/video0") or a URL, and gives up on a network
  // camera that does not answer within a few seconds.
  static std::optional<VideoReader> OpenFile(const std::filesystem::path& file, std::string* why);
  static std::optional<VideoReader> OpenCamera(const std::string& source, std::string* why);

  VideoReader(VideoReader&&) noexcept;
  VideoReader& operator=(VideoReader&&) noexcept;
  ~VideoReader();

  // Reads the next frame. kUndecodable: there was one, but it has no valid image.
  ReadStatus Read(GrayImage& image);
  // Passes over the next frame; false at the end.
  bool Skip();
  // Time of the last frame read or skipped by the container's clock, where it has one. OpenCV knows
  // none of the last frames that a decoder had held back: they follow at the nominal rate.
  std::optional<std::int64_t> ContainerTimeNs() const;
  // Nominal; 0: unknown.
  double FrameRateHz() const;
  // What the container claims; nothing when it says none.
  std::optional<std::int64_t> NumFrames() const;

 private:
  struct Capture;
  bool Grab();  // the next frame and its time
  explicit VideoReader(std::unique_ptr<Capture> capture);

  std::unique_ptr<Capture> capture_;
};

}  // namespace lift_slam
