#include "lift_slam/visualization/annotate.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "lift_slam/util/check.h"
#include "lift_slam/visualization/xml_text.h"

namespace lift_slam {
namespace {

// Sub-pixel drawing: OpenCV takes coordinates as integers with this many fractional bits.
constexpr int kShift = 4;
const cv::Scalar kTracked(140, 235, 20);  // BGR
const cv::Scalar kUnmatched(60, 170, 240);

cv::Point Fixed(double x, double y) {
  return {cvRound(x * (1 << kShift)), cvRound(y * (1 << kShift))};
}

void DrawMark(const AnnotatedFrame::Mark& mark, double scale, cv::Mat& image) {
  // The centre of pixel (0, 0) stays the centre of a pixel: scale about the image's corner.
  const cv::Point centre = Fixed((mark.x + 0.5) * scale - 0.5, (mark.y + 0.5) * scale - 0.5);
  const auto radius = [](double px) { return cvRound(px * (1 << kShift)); };
  if (mark.tracked) {
    cv::circle(image, centre, radius(3.0), kTracked, 1, cv::LINE_AA, kShift);
  } else {
    cv::circle(image, centre, radius(1.0), kUnmatched, cv::FILLED, cv::LINE_AA, kShift);
  }
}

std::string DataUri(const cv::Mat& image, const std::string& extension, const std::string& type,
                    const std::vector<int>& parameters) {
  std::vector<unsigned char> bytes;
  LIFT_SLAM_CHECK(!image.empty() && cv::imencode(extension, image, bytes, parameters),
                  "cannot encode a {} x {} image", image.cols, image.rows);
  return "data:" + type + ";base64," + Base64(bytes.data(), bytes.size());
}

}  // namespace

cv::Mat DrawTrackedPoints(const AnnotatedFrame& frame, int max_width_px) {
  if (frame.image.empty()) return {};
  const double scale = std::min(1.0, static_cast<double>(max_width_px) / frame.image.width());
  cv::Mat image;
  const int height = std::max(1, cvRound(frame.image.height() * scale));
  const int width = std::max(1, cvRound(frame.image.width() * scale));
  cv::resize(frame.image.mat(), image, {width, height}, 0.0, 0.0, cv::INTER_AREA);
  cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  for (const bool tracked : {false, true}) {  // tracked points on top
    for (const AnnotatedFrame::Mark& mark : frame.marks) {
      if (mark.tracked == tracked) DrawMark(mark, scale, image);
    }
  }
  return image;
}

std::string JpegDataUri(const cv::Mat& image, int quality) {
  return DataUri(image, ".jpg", "image/jpeg",
                 {cv::IMWRITE_JPEG_QUALITY, quality, cv::IMWRITE_JPEG_OPTIMIZE, 1});
}

std::string PngDataUri(const cv::Mat& image) {
  return DataUri(image, ".png", "image/png", {cv::IMWRITE_PNG_COMPRESSION, 9});
}

}  // namespace lift_slam
