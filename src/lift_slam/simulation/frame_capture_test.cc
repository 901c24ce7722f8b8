#include "lift_slam/simulation/frame_capture.h"

#include <gtest/gtest.h>

#include "lift_slam/simulation/test_views.h"

namespace lift_slam {
namespace {

CapturedFrame Capture(const SensorOptions& options, double time_s) {
  return CaptureFrame(WallView, StraightMotion(), options, ImageColor::kRgb, 1, 0, time_s);
}

std::uint8_t Red(const CapturedFrame& frame, int row) {
  return frame.color->values[static_cast<std::size_t>(3 * 64 * row)];
}

TEST(CaptureFrame, WithoutEffectsIsTheViewItself) {
  const CapturedFrame frame = Capture({}, 0.77);
  const RenderedView view = WallView(Inverse(StraightMotion().WorldFromCam(0.77)));
  EXPECT_EQ(frame.color->values, view.rgb);
  EXPECT_EQ(frame.gray.values, ToBytes(view, ImageColor::kGray).values);
  EXPECT_EQ(frame.depth_m, view.depth_m);
}

TEST(CaptureFrame, MotionBlurAveragesLightOverTheExposure) {
  SensorOptions options;
  options.motion_blur = {0.5, 11};
  const CapturedFrame frame = Capture(options, 1.0);
  double light = 0.0;
  for (int i = 0; i < 11; ++i) {
    const double z = 1.0 + 0.5 * ((i + 0.5) / 11 - 0.5);
    light += std::pow(std::round(100.0 * z) / 255.0, 2.2) / 11;
  }
  EXPECT_NEAR(Red(frame, 0), 255.0 * std::pow(light, 1.0 / 2.2), 1.0);
  EXPECT_FLOAT_EQ(frame.depth_m[0], 9.0F);  // of the middle of the exposure
}

TEST(CaptureFrame, RollingShutterShowsLaterRowsLater) {
  SensorOptions options;
  options.rolling_shutter = {0.4, 8};
  const CapturedFrame frame = Capture(options, 1.0);
  EXPECT_EQ(Red(frame, 0), 83);  // 1 s - 0.4 s * 7/16, in cm
  EXPECT_EQ(Red(frame, 5), 83);  // the same band
  EXPECT_EQ(Red(frame, 6), 88);  // the next
  EXPECT_EQ(Red(frame, 47), 118);
  EXPECT_NEAR(frame.depth_m.front(), 9.175F, 1e-4);
  EXPECT_NEAR(frame.depth_m.back(), 8.825F, 1e-4);
}

TEST(CaptureFrame, GrayDoesNotDependOnColor) {
  SensorOptions options;
  options.noise.full_well_electrons = 500.0;
  const CapturedFrame both = Capture(options, 0.5);
  const CapturedFrame gray =
      CaptureFrame(WallView, StraightMotion(), options, ImageColor::kGray, 1, 0, 0.5);
  EXPECT_EQ(both.gray.values, gray.gray.values);
  EXPECT_FALSE(gray.color);
}

}  // namespace
}  // namespace lift_slam
