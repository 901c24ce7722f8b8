#include "lift_slam/visualization/contact_sheet.h"

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

constexpr int kSheetWidthPx = 1680;
constexpr int kGapPx = 14;
constexpr int kLabelHeightPx = 34;
constexpr double kLetterSize = 0.7;

std::string Encode(const cv::Mat& picture) {
  std::vector<unsigned char> bytes;
  LIFT_SLAM_CHECK(cv::imencode(".png", picture, bytes), "cannot encode a {} x {} picture",
                  picture.cols, picture.rows);
  return {bytes.begin(), bytes.end()};
}

void DrawCell(const LabelledImage& cell, cv::Rect place, cv::Mat& sheet) {
  const bool is_smaller = place.width < cell.image.width();
  cv::Mat pixels;
  cv::resize(cell.image.mat(), pixels, place.size(), 0, 0,
             is_smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
  pixels.copyTo(sheet(place));
  cv::rectangle(sheet, place, cv::Scalar(150), 1);  // white images end somewhere too
  cv::putText(sheet, cell.label, {place.x, place.y - 9}, cv::FONT_HERSHEY_SIMPLEX, kLetterSize,
              cv::Scalar(20), 1, cv::LINE_AA);
}

}  // namespace

std::string ContactSheet(std::span<const LabelledImage> images, int num_columns) {
  LIFT_SLAM_CHECK(!images.empty() && num_columns > 0, "a sheet of {} images", images.size());
  const int width = (kSheetWidthPx - kGapPx) / num_columns - kGapPx;
  int height = 1;
  for (const LabelledImage& cell : images) {
    LIFT_SLAM_CHECK(!cell.image.empty(), "the image '{}' is empty", cell.label);
    height = std::max(height, cell.image.height() * width / cell.image.width());
  }
  const int num_rows = (static_cast<int>(images.size()) + num_columns - 1) / num_columns;
  const int row_height = kLabelHeightPx + height + kGapPx;
  cv::Mat sheet(num_rows * row_height, kSheetWidthPx, CV_8UC1, cv::Scalar(255));
  for (int i = 0; i < static_cast<int>(images.size()); ++i) {
    const GrayImage& image = images[static_cast<std::size_t>(i)].image;
    const cv::Rect place(kGapPx + i % num_columns * (width + kGapPx),
                         i / num_columns * row_height + kLabelHeightPx, width,
                         std::max(1, image.height() * width / image.width()));
    DrawCell(images[static_cast<std::size_t>(i)], place, sheet);
  }
  return Encode(sheet);
}

std::string EncodePng(const GrayImage& image) {
  LIFT_SLAM_CHECK(!image.empty(), "a PNG file of an empty image");
  return Encode(image.mat());
}

}  // namespace lift_slam
