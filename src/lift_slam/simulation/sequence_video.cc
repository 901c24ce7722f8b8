#include "lift_slam/simulation/sequence_video.h"

#include <fmt/format.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

namespace fs = std::filesystem;

cv::Mat ReadImage(const fs::path& path, cv::Size size) {
  cv::Mat image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (image.empty()) throw InputError(fmt::format("{}: is no image", path.string()));
  if (!size.empty() && image.size() != size) {
    throw InputError(fmt::format("{}: is {}x{} pixels, expected {}x{}", path.string(), image.cols,
                                 image.rows, size.width, size.height));
  }
  return image;
}

cv::VideoWriter OpenWriter(const fs::path& path, double rate_hz, const cv::Mat& first) {
  for (const char* codec : {"avc1", "mp4v"}) {
    const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
    cv::VideoWriter writer(path.string(), cv::CAP_FFMPEG, fourcc, rate_hz, first.size(),
                           first.channels() == 3);
    if (writer.isOpened()) return writer;
  }
  throw InputError(fmt::format(
      "{}: a video cannot be written there (expected a file name such as drive.mp4 in a folder "
      "that exists, and an OpenCV with FFmpeg)",
      path.string()));
}

}  // namespace

void CheckVideoSize(const fs::path& path, int width, int height) {
  if (width % 2 == 0 && height % 2 == 0) return;
  throw InputError(fmt::format("{}: a video needs an even width and height, the images are {}x{}",
                               path.string(), width, height));
}

bool WriteVideo(const fs::path& path, const std::vector<fs::path>& images, double rate_hz,
                const std::function<bool()>& stop) {
  LIFT_SLAM_CHECK(!images.empty(), "a video needs images");
  const cv::Mat first = ReadImage(images.front(), {});
  CheckVideoSize(path, first.cols, first.rows);
  // The ending tells the container's kind.
  const fs::path temporary =
      path.parent_path() / (path.stem().string() + ".part" + path.extension().string());
  bool stopped = false;
  {
    cv::VideoWriter writer = OpenWriter(temporary, rate_hz, first);
    for (const fs::path& image : images) {
      stopped = stop && stop();
      if (stopped) break;
      writer.write(ReadImage(image, first.size()));
    }
  }
  std::error_code error;
  if (stopped) {
    fs::remove(temporary, error);
    return false;
  }
  fs::rename(temporary, path, error);
  if (error)
    throw InputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
  return true;
}

}  // namespace lift_slam
