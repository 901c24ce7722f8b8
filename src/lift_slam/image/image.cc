#include "lift_slam/image/image.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

cv::Mat ToEightBit(const cv::Mat& mat) {
  cv::Mat out = mat;
  if (mat.depth() == CV_16U) mat.convertTo(out, CV_8U, 1.0 / 256.0);
  if (mat.depth() == CV_32F || mat.depth() == CV_64F) mat.convertTo(out, CV_8U, 255.0);
  LIFT_SLAM_CHECK(out.depth() == CV_8U, "image depth {} is not supported", mat.depth());
  return out;
}

}  // namespace

GrayImage::GrayImage(cv::Mat mat) : mat_(std::move(mat)) {
  LIFT_SLAM_CHECK(mat_.empty() || mat_.type() == CV_8UC1, "matrix type {} is not 8-bit grey",
                  mat_.type());
}

GrayImage ToGray(const cv::Mat& decoded) {
  const cv::Mat eight_bit = ToEightBit(decoded);
  cv::Mat gray;
  switch (eight_bit.channels()) {
    case 1:
      gray = eight_bit;
      break;
    case 3:
      cv::cvtColor(eight_bit, gray, cv::COLOR_BGR2GRAY);
      break;
    case 4:
      cv::cvtColor(eight_bit, gray, cv::COLOR_BGRA2GRAY);
      break;
    default:
      cv::extractChannel(eight_bit, gray, 0);  // grey with alpha
  }
  return GrayImage(gray);
}

std::optional<GrayImage> ReadGrayImage(const std::filesystem::path& path, std::string* why) {
  const auto refuse = [&](const char* reason) -> std::optional<GrayImage> {
    if (why != nullptr) *why = path.string() + ": " + reason;
    return std::nullopt;
  };
  if (!std::filesystem::exists(path)) return refuse("no such file");
  cv::Mat decoded;
  try {
    decoded = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return refuse("cannot be decoded");
  }
  if (decoded.empty()) return refuse("cannot be decoded (truncated or no image)");
  return ToGray(decoded);
}

}  // namespace lift_slam
