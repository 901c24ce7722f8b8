#include "lift_slam/image/image.h"

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "lift_slam/image/image_file.h"
#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

bool IsSupportedDepth(int depth) {
  return depth == CV_8U || depth == CV_16U || depth == CV_32F || depth == CV_64F;
}

std::optional<std::vector<std::uint8_t>> ReadBytes(const std::filesystem::path& path) {
  std::error_code error;
  // Opening a pipe would wait for who writes to it.
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream stream(path, std::ios::binary);
  if (error || !stream) return std::nullopt;
  std::vector<std::uint8_t> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) return std::nullopt;
  return bytes;
}

cv::Mat ToEightBit(const cv::Mat& mat) {
  LIFT_SLAM_CHECK(IsSupportedDepth(mat.depth()), "image depth {} is not supported", mat.depth());
  cv::Mat out = mat;
  if (mat.depth() == CV_16U) mat.convertTo(out, CV_8U, 1.0 / 256.0);
  if (mat.depth() == CV_32F || mat.depth() == CV_64F) mat.convertTo(out, CV_8U, 255.0);
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
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return refuse("no such file");
  const std::optional<std::vector<std::uint8_t>> file = ReadBytes(path);
  if (!file) return refuse("cannot be read");
  if (file->empty()) return refuse("is empty");
  if (!IsCompleteImageFile(*file)) return refuse("is truncated");
  cv::Mat decoded;
  try {
    decoded = cv::imdecode(*file, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return refuse("cannot be decoded");
  }
  if (decoded.empty()) return refuse("cannot be decoded (damaged, or no image)");
  if (!IsSupportedDepth(decoded.depth())) return refuse("has pixels of an unsupported type");
  return ToGray(decoded);
}

}  // namespace lift_slam
