#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

namespace lift_slam {

// An 8-bit grey image. OpenCV stays inside: only image/, features/orb/ and visualization/ look at
// mat(). Copies share the pixels, which nobody changes after construction.
class GrayImage {
 public:
  GrayImage() = default;
  // Takes a CV_8UC1 matrix (any stride); CheckError otherwise.
  explicit GrayImage(cv::Mat mat);

  int width() const { return mat_.cols; }
  int height() const { return mat_.rows; }
  bool empty() const { return mat_.empty(); }
  const std::uint8_t* row(int y) const { return mat_.ptr<std::uint8_t>(y); }
  const cv::Mat& mat() const { return mat_; }

 private:
  cv::Mat mat_;
};

// Grey 8 bit from any decoded image: colour by the usual weights, alpha dropped, 16 bit scaled by
// 1/256, floating point (0 to 1) by 255.
GrayImage ToGray(const cv::Mat& decoded);

// Decodes a file; nothing when it is missing, truncated or no image. `why` (when given) then says
// what was wrong.
std::optional<GrayImage> ReadGrayImage(const std::filesystem::path& path,
                                       std::string* why = nullptr);

}  // namespace lift_slam
