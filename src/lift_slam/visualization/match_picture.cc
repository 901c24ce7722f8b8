#include "lift_slam/visualization/match_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "lift_slam/util/check.h"

namespace lift_slam {
namespace {

// OpenCV takes coordinates as integers with this many fractional bits.
constexpr int kShift = 4;
constexpr int kGapPx = 6;  // between the images
constexpr int kMinWidthPx = 640;
constexpr int kLineHeightPx = 24;                                // of a caption
const cv::Scalar kInlier(120, 230, 60), kOutlier(40, 130, 250);  // BGR
const cv::Scalar kBackground(28, 28, 28), kText(235, 235, 235);

// Where the pixels of the two images lie in the picture.
struct Layout {
  int factor = 1;  // enlargement
  cv::Point corner_a, corner_b;
  cv::Size size;
};

cv::Size SizeOf(const GrayImage& image) { return {image.width(), image.height()}; }

Layout Arrange(cv::Size a, cv::Size b, int num_captions) {
  const bool is_wide = a.width > 3 * a.height / 2;
  Layout layout;
  layout.size = is_wide ? cv::Size(std::max(a.width, b.width), a.height + b.height)
                        : cv::Size(a.width + b.width, std::max(a.height, b.height));
  layout.factor = std::max(1, (kMinWidthPx + layout.size.width - 1) / layout.size.width);
  layout.size *= layout.factor;
  layout.corner_a = {0, kLineHeightPx * num_captions + kGapPx};
  const cv::Point beside = is_wide ? cv::Point(0, layout.factor * a.height + kGapPx)
                                   : cv::Point(layout.factor * a.width + kGapPx, 0);
  layout.corner_b = layout.corner_a + beside;
  layout.size.height += layout.corner_a.y + (is_wide ? kGapPx : 0);
  layout.size.width += is_wide ? 0 : kGapPx;
  return layout;
}

// Darkened, so that the lines stand out.
void DrawImage(const GrayImage& image, const Layout& layout, cv::Point corner, cv::Mat& picture) {
  cv::Mat pixels;
  cv::resize(image.mat(), pixels, SizeOf(image) * layout.factor, 0, 0, cv::INTER_LINEAR);
  cv::cvtColor(pixels, pixels, cv::COLOR_GRAY2BGR);
  pixels.convertTo(pixels, CV_8U, 0.75);
  pixels.copyTo(picture(cv::Rect(corner, pixels.size())));
}

cv::Point InPicture(const Keypoint& keypoint, const Layout& layout, cv::Point corner) {
  const auto fixed = [&](double position, int offset) {
    return cvRound(((position + 0.5) * layout.factor - 0.5 + offset) * (1 << kShift));
  };
  return {fixed(keypoint.x, corner.x), fixed(keypoint.y, corner.y)};
}

void DrawMatch(const Keypoint& a, const Keypoint& b, const cv::Scalar& colour, const Layout& layout,
               cv::Mat& picture) {
  const cv::Point from = InPicture(a, layout, layout.corner_a);
  const cv::Point to = InPicture(b, layout, layout.corner_b);
  cv::line(picture, from, to, colour, 1, cv::LINE_AA, kShift);
  for (const cv::Point& end : {from, to}) {
    cv::circle(picture, end, 3 << kShift, colour, 1, cv::LINE_AA, kShift);
  }
}

void DrawCaption(const std::string& text, int line, cv::Mat& picture) {
  constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX, kMarginPx = 8;
  int baseline = 0;
  const int width = cv::getTextSize(text, kFont, 0.55, 1, &baseline).width;
  const double fit = static_cast<double>(picture.cols - 2 * kMarginPx) / std::max(1, width);
  cv::putText(picture, text, {kMarginPx, kLineHeightPx * line + 18}, kFont,
              0.55 * std::min(1.0, fit), kText, 1, cv::LINE_AA);
}

}  // namespace

std::string MatchPicture(const GrayImage& image_a, const GrayImage& image_b, const FeatureSet& a,
                         const FeatureSet& b, std::span<const ImagePairMatch> matches,
                         std::span<const std::string> captions) {
  LIFT_SLAM_CHECK(!image_a.empty() && !image_b.empty(), "a picture of an empty image");
  const Layout layout =
      Arrange(SizeOf(image_a), SizeOf(image_b), static_cast<int>(captions.size()));
  cv::Mat picture(layout.size, CV_8UC3, kBackground);
  DrawImage(image_a, layout, layout.corner_a, picture);
  DrawImage(image_b, layout, layout.corner_b, picture);
  for (const bool inliers : {false, true}) {  // inliers on top
    for (const ImagePairMatch& match : matches) {
      if (match.is_inlier != inliers) continue;
      DrawMatch(a.keypoints[static_cast<std::size_t>(match.a)],
                b.keypoints[static_cast<std::size_t>(match.b)], inliers ? kInlier : kOutlier,
                layout, picture);
    }
  }
  for (std::size_t i = 0; i < captions.size(); ++i) {
    DrawCaption(captions[i], static_cast<int>(i), picture);
  }
  std::vector<unsigned char> bytes;
  LIFT_SLAM_CHECK(cv::imencode(".png", picture, bytes), "cannot encode a {} x {} picture",
                  picture.cols, picture.rows);
  return {bytes.begin(), bytes.end()};
}

}  // namespace lift_slam
