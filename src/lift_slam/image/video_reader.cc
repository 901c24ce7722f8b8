#include "lift_slam/image/video_reader.h"

#include <cmath>
#include <opencv2/videoio.hpp>
#include <opencv2/videoio/registry.hpp>

namespace lift_slam {
namespace {

constexpr int kOpenTimeoutMs = 10'000;
constexpr int kReadTimeoutMs = 5'000;
constexpr double kMaxPlausibleFrames = 1e9;

bool IsIndex(const std::string& source) {
  return !source.empty() && source.size() < 6 &&
         source.find_first_not_of("0123456789") == std::string::npos;
}

// The backends are named, because the search through all of them prints the complaints of each;
// it is left for builds of OpenCV without the usual one.
bool HasBackend(cv::VideoCaptureAPIs backend) { return cv::videoio_registry::hasBackend(backend); }

bool OpenFileCapture(cv::VideoCapture& capture, const std::string& file) {
  if (!HasBackend(cv::CAP_FFMPEG)) return capture.open(file);
  return capture.open(file, cv::CAP_FFMPEG) || capture.open(file, cv::CAP_OPENCV_MJPEG);
}

bool OpenUrlCapture(cv::VideoCapture& capture, const std::string& url) {
  if (!HasBackend(cv::CAP_FFMPEG)) return capture.open(url);
  return capture.open(url, cv::CAP_FFMPEG,
                      {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, kOpenTimeoutMs,
                       cv::CAP_PROP_READ_TIMEOUT_MSEC, kReadTimeoutMs});
}

bool OpenCameraCapture(cv::VideoCapture& capture, const std::string& source) {
  if (source.find("://") != std::string::npos) return OpenUrlCapture(capture, source);
  const int backend = HasBackend(cv::CAP_V4L2) ? cv::CAP_V4L2 : cv::CAP_ANY;
  return IsIndex(source) ? capture.open(std::stoi(source), backend) : capture.open(source, backend);
}

}  // namespace

struct VideoReader::Capture {
  cv::VideoCapture capture;
  std::optional<double> time_ms;  // of the last frame
};

VideoReader::VideoReader(std::unique_ptr<Capture> capture) : capture_(std::move(capture)) {}
VideoReader::VideoReader(VideoReader&&) noexcept = default;
VideoReader& VideoReader::operator=(VideoReader&&) noexcept = default;
VideoReader::~VideoReader() = default;

std::optional<VideoReader> VideoReader::OpenFile(const std::filesystem::path& file,
                                                 std::string* why) {
  auto capture = std::make_unique<Capture>();
  bool open = false;
  try {
    open = OpenFileCapture(capture->capture, file.string());
  } catch (const cv::Exception&) {
  }
  if (open) return VideoReader(std::move(capture));
  if (why != nullptr) *why = file.string() + ": cannot be opened as a video";
  return std::nullopt;
}

std::optional<VideoReader> VideoReader::OpenCamera(const std::string& source, std::string* why) {
  auto capture = std::make_unique<Capture>();
  bool open = false;
  try {
    open = OpenCameraCapture(capture->capture, source);
  } catch (const cv::Exception&) {
  }
  if (open) {
    // Old images are of no use when tracking falls behind; not every driver obeys.
    capture->capture.set(cv::CAP_PROP_BUFFERSIZE, 1);
    return VideoReader(std::move(capture));
  }
  if (why != nullptr) *why = "the camera " + source + " cannot be opened";
  return std::nullopt;
}

VideoReader::ReadStatus VideoReader::Read(GrayImage& image) {
  cv::Mat frame;
  try {
    if (!Grab()) return ReadStatus::kEnd;
    if (!capture_->capture.retrieve(frame) || frame.empty()) return ReadStatus::kUndecodable;
  } catch (const cv::Exception&) {
    return ReadStatus::kUndecodable;
  }
  image = ToGray(frame.channels() == 1 ? frame.clone() : frame);
  return ReadStatus::kImage;
}

bool VideoReader::Skip() { return Grab(); }

bool VideoReader::Grab() {
  if (!capture_->capture.grab()) return false;
  const std::optional<double> before_ms = capture_->time_ms;
  const double time_ms = capture_->capture.get(cv::CAP_PROP_POS_MSEC);
  const double rate_hz = FrameRateHz();
  if (time_ms == 0.0 && before_ms > 0.0 && rate_hz > 0.0) {
    capture_->time_ms = *before_ms + 1e3 / rate_hz;
  } else {
    capture_->time_ms = time_ms;
  }
  return true;
}

std::optional<std::int64_t> VideoReader::ContainerTimeNs() const {
  const double time_ms = capture_->time_ms.value_or(-1.0);
  if (!std::isfinite(time_ms) || time_ms < 0.0 || time_ms > 1e12) return std::nullopt;
  return std::llround(time_ms * 1e6);
}

double VideoReader::FrameRateHz() const {
  const double rate = capture_->capture.get(cv::CAP_PROP_FPS);
  return std::isfinite(rate) && rate > 0.0 && rate < 1e5 ? rate : 0.0;
}

std::optional<std::int64_t> VideoReader::NumFrames() const {
  const double count = capture_->capture.get(cv::CAP_PROP_FRAME_COUNT);
  if (!(count >= 1.0 && count < kMaxPlausibleFrames)) return std::nullopt;
  return std::llround(count);
}

}  // namespace lift_slam
