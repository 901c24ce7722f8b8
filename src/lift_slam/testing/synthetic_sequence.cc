#include "lift_slam/testing/synthetic_sequence.h"

#include <cmath>
#include <numbers>

namespace lift_slam {

Camera SyntheticCamera() {
  Camera camera;
  camera.pinhole = {500.0, 500.0, 319.5, 239.5, 640, 480};
  camera.source = "synthetic camera";
  return camera;
}

namespace {

const Camera& Checked(const Camera& camera) {
  camera.Check();
  return camera;
}

}  // namespace

SyntheticSequence::SyntheticSequence(const SyntheticSequenceOptions& options)
    : options_(options),
      world_(options.path == SyntheticPath::kStreetDrive ? MakeStreet(options.seed)
                                                         : MakeRoom(options.seed)),
      renderer_(Checked(options.camera)) {
  options_.camera.frame_rate_hz = options.frame_rate_hz;
}

double SyntheticSequence::TimeS(int frame) const { return frame / options_.frame_rate_hz; }

std::int64_t SyntheticSequence::TimestampNs(int frame) const {
  return std::llround(TimeS(frame) * 1e9);
}

Rigid3d SyntheticSequence::WorldFromCam(int frame) const {
  return WorldFromCamOnPath(options_.path, TimeS(frame));
}

GrayImage SyntheticSequence::Render(int frame) const {
  PictureOptions render;
  render.noise_gray = options_.noise_gray;
  render.noise_seed = options_.seed * 1000003 + static_cast<std::uint64_t>(frame);
  render.exposure =
      1.0 + options_.exposure_change * std::sin(2.0 * std::numbers::pi * TimeS(frame) / 5.0);
  return renderer_.Render(world_, Inverse(WorldFromCam(frame)), render);
}

}  // namespace lift_slam
