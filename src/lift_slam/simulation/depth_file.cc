#include "lift_slam/simulation/depth_file.h"

#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "lift_slam/util/check.h"
#include "lift_slam/util/input_error.h"

namespace lift_slam {
namespace {

constexpr float kMaxUnits = 65535.0F;

cv::Mat ToUnits(const DepthImage& image) {
  cv::Mat units(image.height, image.width, CV_16UC1);
  for (int y = 0; y < image.height; ++y) {
    const float* depth = &image.depth_m[static_cast<std::size_t>(y * image.width)];
    auto* row = units.ptr<std::uint16_t>(y);
    for (int x = 0; x < image.width; ++x) {
      const float value = std::round(depth[x] * static_cast<float>(kDepthUnitsPerM));
      row[x] = value <= kMaxUnits ? static_cast<std::uint16_t>(value) : std::uint16_t{0};
    }
  }
  return units;
}

}  // namespace

std::string DepthExtension(DepthFormat format) {
  return format == DepthFormat::kPng16 ? ".png" : ".tiff";
}

std::vector<std::uint8_t> EncodeDepth(const DepthImage& image, DepthFormat format) {
  std::vector<std::uint8_t> bytes;
  bool encoded = false;
  if (format == DepthFormat::kPng16) {
    encoded = cv::imencode(".png", ToUnits(image), bytes, {cv::IMWRITE_PNG_COMPRESSION, 3});
  } else {
    cv::Mat metres(image.height, image.width, CV_32FC1);
    std::copy(image.depth_m.begin(), image.depth_m.end(), metres.ptr<float>());
    encoded = cv::imencode(".tiff", metres, bytes);
  }
  LIFT_SLAM_CHECK(encoded, "a depth image of {}x{} cannot be encoded", image.width, image.height);
  return bytes;
}

DepthImage ReadDepth(const std::filesystem::path& path) {
  cv::Mat mat = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  if (mat.empty() || (mat.type() != CV_16UC1 && mat.type() != CV_32FC1)) {
    throw InputError(fmt::format("{}: is no depth image (16-bit or floating point, one channel)",
                                 path.string()));
  }
  if (mat.type() == CV_16UC1) mat.convertTo(mat, CV_32FC1, 1.0 / kDepthUnitsPerM);
  DepthImage image{mat.cols, mat.rows, {}};
  image.depth_m.assign(mat.ptr<float>(), mat.ptr<float>() + mat.total());
  return image;
}

}  // namespace lift_slam
