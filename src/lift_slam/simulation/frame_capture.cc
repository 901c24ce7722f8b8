#include "lift_slam/simulation/frame_capture.h"

#include "lift_slam/simulation/sensor_effects.h"

namespace lift_slam {
namespace {

// Rows that are exposed at the same time.
struct Band {
  int first_row, end_row;
  double delay_s;  // of its middle behind the frame's time
};

std::vector<Band> Bands(const RollingShutterOptions& options, int height) {
  if (options.readout_s == 0.0) return {{0, height, 0.0}};
  const int count = std::min(options.bands, height);
  std::vector<Band> bands;
  for (int i = 0; i < count; ++i) {
    const int first = i * height / count, end = (i + 1) * height / count;
    const double middle = 0.5 * (first + end) / height;
    bands.push_back({first, end, (middle - 0.5) * options.readout_s});
  }
  return bands;
}

class Capture {
 public:
  Capture(const ViewSource& view_source, const CameraMotion& motion, const SensorOptions& options,
          ImageColor color, double time_s)
      : view_source_(view_source),
        motion_(motion),
        options_(options),
        color_(color),
        time_s_(time_s),
        view_(view_source(Inverse(motion.WorldFromCam(time_s)))) {
    const std::vector<Band> bands = Bands(options.rolling_shutter, view_.height);
    is_single_ = bands.size() == 1 && Samples() == 1;
    if (is_single_) return;
    depth_m_.resize(view_.depth_m.size());
    for (const Band& band : bands) Gather(band, time_s + band.delay_s);
  }

  CapturedFrame Finish(std::uint64_t seed, int frame, double time_s) {
    CapturedFrame captured;
    captured.gray = Picture(ImageColor::kGray, gray_, seed, frame, time_s);
    if (color_ == ImageColor::kRgb) {
      captured.color = Picture(ImageColor::kRgb, rgb_, seed, frame, time_s);
    }
    captured.depth_m = is_single_ ? std::move(view_.depth_m) : std::move(depth_m_);
    return captured;
  }

 private:
  int Samples() const {
    return options_.motion_blur.exposure_s > 0.0 ? options_.motion_blur.samples : 1;
  }

  RenderedView ViewAt(double time_s) const {
    if (time_s == time_s_) return view_;
    return view_source_(Inverse(motion_.WorldFromCam(time_s)));
  }

  // All samples of the exposure of one band.
  void Gather(const Band& band, double time_s) {
    const int samples = Samples();
    const float weight = 1.0F / static_cast<float>(samples);
    for (int i = 0; i < samples; ++i) {
      const double share = (i + 0.5) / samples - 0.5;
      const RenderedView view = ViewAt(time_s + share * options_.motion_blur.exposure_s);
      AddLight(ToLight(ToBytes(view, ImageColor::kGray)), weight, band.first_row, band.end_row,
               gray_);
      if (color_ == ImageColor::kRgb) {
        AddLight(ToLight(ToBytes(view, ImageColor::kRgb)), weight, band.first_row, band.end_row,
                 rgb_);
      }
      if (i == samples / 2) KeepDepth(view, band);
    }
  }

  void KeepDepth(const RenderedView& view, const Band& band) {
    std::copy(view.depth_m.begin() + std::ptrdiff_t{band.first_row} * view.width,
              view.depth_m.begin() + std::ptrdiff_t{band.end_row} * view.width,
              depth_m_.begin() + std::ptrdiff_t{band.first_row} * view.width);
  }

  ByteImage Picture(ImageColor color, LightImage& light, std::uint64_t seed, int frame,
                    double time_s) const {
    if (is_single_) light = ToLight(ToBytes(view_, color));
    return DevelopFrame(std::move(light), options_, seed, frame, time_s);
  }

  const ViewSource& view_source_;
  const CameraMotion& motion_;
  const SensorOptions& options_;
  ImageColor color_;
  double time_s_;           // of the frame
  RenderedView view_;       // at that time
  bool is_single_ = false;  // that view is enough; else the sum of several, and their depth:
  LightImage gray_, rgb_;
  std::vector<float> depth_m_;
};

}  // namespace

CapturedFrame CaptureFrame(const ViewSource& view_source, const CameraMotion& motion,
                           const SensorOptions& options, ImageColor color, std::uint64_t seed,
                           int frame, double time_s) {
  return Capture(view_source, motion, options, color, time_s).Finish(seed, frame, time_s);
}

}  // namespace lift_slam
